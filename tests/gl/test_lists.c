/* Display lists (GL 2.1 sec. 5.4). */
#include <math.h>

#include "tests/gl/gl.h"

static void triangle(struct gl *gl, float x)
{
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	for (unsigned i = 0; i < 3; i++)
		gl_call(gl, "glVertex3f", "fff", (double)x + i, i == 2 ? 1.0 : 0.0, 0.0);
	gl_call(gl, "glEnd", "");
}

/* COMPILE executes nothing; calling the list does; values set inside remain current afterwards. */
START_TEST(test_compile)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 5u, GL_COMPILE);
	gl_call(&gl, "glColor3f", "fff", 1.0, 0.0, 0.0);
	triangle(&gl, 0);
	gl_call(&gl, "glColor3f", "fff", 0.0, 1.0, 0.0);
	gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glEndList", "");
	ck_assert_floats(3, gl_state(&gl)->a.current.attribute[GLS_ATTR_COLOR], 1, 1, 1);
	gl_call(&gl, "glCallList", "u", 5u);
	gl_call(&gl, "glCallList", "u", 5u);
	gl_call(&gl, "glCallList", "u", 99u); /* no such list: ignored */
	ck_assert_uint_eq(gl_error(&gl), 0);
	ck_assert_floats(3, gl_state(&gl)->a.current.attribute[GLS_ATTR_COLOR], 0, 1, 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->n_meshes, 1);
	ck_assert_floats(3, s->currents[s->instances[1].current].color, 1, 0, 0);
	ck_assert_floats(1, &s->instances[1].modelview[12], 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_compile_and_execute)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 5u, GL_COMPILE_AND_EXECUTE);
	triangle(&gl, 0);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glCallList", "u", 5u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->n_meshes, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Attributes that the list does not set are those current when it is called, even in the middle of a primitive. */
START_TEST(test_inherited)
{
	struct gl gl = gl_open();
	struct scene *s;
	const struct scene_mesh *m;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(&gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 1.0);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 1.0);
	gl_call(&gl, "glEnd", "");
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glColor3f", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	m = s->meshes[0];
	ck_assert_uint_eq(m->attributes, SCENE_HAS_COLOR);
	ck_assert_floats(12, m->color, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A value set for a list's second primitive does not apply to its first, even if it was current in an earlier list. */
START_TEST(test_inherited_by_the_first)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 1.0);
	triangle(&gl, 0);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glNewList", "ue", 2u, GL_COMPILE);
	triangle(&gl, 1);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 1.0);
	triangle(&gl, 2);
	gl_call(&gl, "glColor3f", "fff", 0.0, 1.0, 0.0);
	gl_call(&gl, "glEnable", "e", GL_FOG);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glColor3f", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glCallList", "u", 2u);
	ck_assert_floats(3, gl_state(&gl)->a.current.attribute[GLS_ATTR_COLOR], 0, 1, 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_primitives, 2);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_floats(3, s->currents[s->instances[0].current].color, 1, 0, 0);
	ck_assert_floats(3, s->currents[s->instances[1].current].color, 0, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Vertices from a list between Begin and End outside it. */
START_TEST(test_vertices_only)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	for (unsigned i = 0; i < 3; i++)
		gl_call(&gl, "glVertex2f", "ff", (double)i, i == 2 ? 1.0 : 0.0);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(&gl, "glCallList", "u", 1u);
	gl_call(&gl, "glEnd", "");
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_primitives, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* CallLists with a base and each type of names; nesting; the base is read when the list is called. */
START_TEST(test_call_lists)
{
	static const struct { uint32_t type; size_t n; uint8_t bytes[8]; } names[] = {
		{ GL_UNSIGNED_BYTE, 2, { 1, 2 } },
		{ GL_SHORT, 4, { 1, 0, 2, 0 } },
		{ GL_UNSIGNED_INT, 8, { 1, 0, 0, 0, 2, 0, 0, 0 } },
		{ GL_FLOAT, 8, { 0, 0, 0x80, 0x3f, 0, 0, 0, 0x40 } },
		{ GL_2_BYTES, 4, { 0, 1, 0, 2 } },
		{ GL_3_BYTES, 6, { 0, 0, 1, 0, 0, 2 } },
		{ GL_4_BYTES, 8, { 0, 0, 0, 1, 0, 0, 0, 2 } },
	};
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 1; i <= 2; i++) {
		gl_call(&gl, "glNewList", "ue", 100u + i, GL_COMPILE);
		triangle(&gl, (float)i);
		gl_call(&gl, "glEndList", "");
	}
	gl_call(&gl, "glListBase", "u", 100u);
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		gl_call(&gl, "glNewList", "ue", 7u, GL_COMPILE);
		gl_call(&gl, "glCallLists", "ieb", 2, names[i].type, names[i].n, names[i].bytes);
		gl_call(&gl, "glEndList", "");
		gl_call(&gl, "glCallList", "u", 7u);
		s = gl_swap(&gl);
		ck_assert_uint_eq(s->n_instances, 2);
		ck_assert_floats(1, s->meshes[s->instances[1].mesh]->position, 2);
		scene_release(&s);
	}
	gl_call(&gl, "glCallLists", "ieb", 2, 77u, names[0].n, names[0].bytes);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

/* A list that calls itself ends; a list that is recompiled or deleted is a different one. */
START_TEST(test_recursion_and_deletion)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	triangle(&gl, 0);
	gl_call(&gl, "glCallList", "u", 1u);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 64);
	scene_release(&s);
	gl_call(&gl, "glDeleteLists", "ui", 0u, 0x7fffffff);
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_errors)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glEndList", "");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glNewList", "ue", 0u, GL_COMPILE);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glNewList", "ue", 1u, 5u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glNewList", "ue", 2u, GL_COMPILE);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glMatrixMode", "e", 3u); /* an error when executed, not when compiled */
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glCallList", "u", 1u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

/* Faces that each repeat the same material become one mesh. */
START_TEST(test_redundant_state)
{
	static const float red[4] = { 1, 0, 0, 1 }, blue[4] = { 0, 0, 1, 1 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	for (unsigned i = 0; i < 6; i++) {
		gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT, GL_SPECULAR, 4, red);
		gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT, GL_AMBIENT_AND_DIFFUSE, 4, i < 4 ? red : blue);
		triangle(&gl, (float)i);
	}
	gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT, GL_DIFFUSE, 4, red);
	gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT, GL_AMBIENT_AND_DIFFUSE, 4, blue);
	triangle(&gl, 7);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->meshes[s->instances[0].mesh]->primitive_count, 4);
	ck_assert_floats(3, s->materials[s->instances[0].material].front.diffuse, 1, 0, 0);
	ck_assert_floats(3, s->materials[s->instances[1].material].front.diffuse, 0, 0, 1);
	ck_assert_floats(3, s->materials[s->instances[2].material].front.diffuse, 0, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Lists that call lists twice each, forty deep, still end; a list that calls another a thousand times is executed
 * completely. */
START_TEST(test_lists_without_end)
{
	struct gl gl = gl_open();

	for (unsigned list = 1; list <= 40; list++) {
		gl_call(&gl, "glNewList", "ue", list, GL_COMPILE);
		gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
		for (unsigned i = 0; i < 2 && list > 1; i++)
			gl_call(&gl, "glCallList", "u", list - 1);
		gl_call(&gl, "glEndList", "");
	}
	gl_call(&gl, "glNewList", "ue", 50u, GL_COMPILE);
	for (unsigned i = 0; i < 1000; i++)
		gl_call(&gl, "glCallList", "u", 1u);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glCallList", "u", 50u);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	ck_assert_floats(1, &gl_state(&gl)->modelview.matrices[0][12], 1000);
	gl_call(&gl, "glCallList", "u", 40u);
	ck_assert_uint_gt(gl_unsupported(&gl), 0);
	gl_close(&gl);
}
END_TEST

GL_TESTS("lists", test_compile, test_compile_and_execute, test_inherited, test_inherited_by_the_first,
         test_vertices_only, test_call_lists, test_recursion_and_deletion, test_errors, test_lists_without_end,
         test_redundant_state)
