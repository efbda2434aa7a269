/* Begin/End: how primitives are split, and which attributes vary or are constant (GL 2.1 sec. 2.6). */
#include <math.h>

#include "tests/gl/gl.h"

static void vertices(struct gl *gl, uint32_t mode, unsigned n)
{
	gl_call(gl, "glBegin", "e", mode);
	for (unsigned i = 0; i < n; i++)
		gl_call(gl, "glVertex2f", "ff", (double)i, 0.0);
	gl_call(gl, "glEnd", "");
}

static void check_cut(uint32_t mode, unsigned n, enum scene_primitive kind, unsigned n_primitives,
                      const uint32_t *index)
{
	struct gl gl = gl_open();
	struct scene *s;

	vertices(&gl, mode, n);
	s = gl_swap(&gl);
	if (n_primitives == 0) {
		ck_assert_uint_eq(s->n_instances, 0);
	} else {
		ck_assert_uint_eq(s->n_instances, 1);
		ck_assert_int_eq(s->meshes[0]->kind, kind);
		ck_assert_uint_eq(s->meshes[0]->primitive_count, n_primitives);
		ck_assert_mem_eq(s->meshes[0]->index, index, n_primitives * kind * sizeof(*index));
	}
	scene_release(&s);
	gl_close(&gl);
}

/* Sec. 2.6.1; the order of triangles is that of Mesa 22.3.6 (llvmpipe), with the provoking vertex last. */
START_TEST(test_cut)
{
	check_cut(GL_POINTS, 2, SCENE_POINTS, 2, (uint32_t[]){ 0, 1 });
	check_cut(GL_LINES, 5, SCENE_LINES, 2, (uint32_t[]){ 0, 1, 2, 3 });
	check_cut(GL_LINE_STRIP, 3, SCENE_LINES, 2, (uint32_t[]){ 0, 1, 1, 2 });
	check_cut(GL_LINE_LOOP, 3, SCENE_LINES, 3, (uint32_t[]){ 0, 1, 1, 2, 2, 0 });
	check_cut(GL_TRIANGLES, 7, SCENE_TRIANGLES, 2, (uint32_t[]){ 0, 1, 2, 3, 4, 5 });
	check_cut(GL_TRIANGLE_STRIP, 5, SCENE_TRIANGLES, 3, (uint32_t[]){ 0, 1, 2, 2, 1, 3, 2, 3, 4 });
	check_cut(GL_TRIANGLE_FAN, 4, SCENE_TRIANGLES, 2, (uint32_t[]){ 0, 1, 2, 0, 2, 3 });
	check_cut(GL_QUADS, 7, SCENE_TRIANGLES, 2, (uint32_t[]){ 0, 1, 3, 1, 2, 3 });
	check_cut(GL_QUAD_STRIP, 6, SCENE_TRIANGLES, 4, (uint32_t[]){ 0, 1, 3, 2, 0, 3, 2, 3, 5, 4, 2, 5 });
	check_cut(GL_POLYGON, 4, SCENE_TRIANGLES, 2, (uint32_t[]){ 1, 2, 0, 2, 3, 0 });
	check_cut(GL_TRIANGLES, 2, SCENE_TRIANGLES, 0, NULL);
	check_cut(GL_QUADS, 3, SCENE_TRIANGLES, 0, NULL);
}
END_TEST

/* ARB_provoking_vertex: primitives that use the first vertex; lists were split when compiled, which is reported if
 * it shows. */
START_TEST(test_provoking)
{
	static const uint32_t strip[] = { 1, 2, 0, 3, 2, 1 }, fan[] = { 2, 0, 1, 3, 0, 2 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	vertices(&gl, GL_TRIANGLES, 3);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glProvokingVertex", "e", GL_FIRST_VERTEX_CONVENTION);
	gl_call(&gl, "glProvokingVertexEXT", "e", GL_FLAT);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glCallList", "u", 1u);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_call(&gl, "glPushAttrib", "m", GL_LIGHTING_BIT);
	gl_call(&gl, "glShadeModel", "e", GL_FLAT);
	gl_call(&gl, "glCallList", "u", 1u);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_call(&gl, "glProvokingVertex", "e", GL_LAST_VERTEX_CONVENTION);
	gl_call(&gl, "glPopAttrib", "");
	vertices(&gl, GL_TRIANGLE_STRIP, 4);
	gl_call(&gl, "glShadeModel", "e", GL_FLAT); /* a separate mesh */
	vertices(&gl, GL_TRIANGLE_FAN, 4);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 4);
	ck_assert_mem_eq(s->meshes[s->instances[2].mesh]->index, strip, sizeof(strip));
	ck_assert_mem_eq(s->meshes[s->instances[3].mesh]->index, fan, sizeof(fan));
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.6.2: inner edges of split primitives are not drawn; flags apply to polygons and quads. */
START_TEST(test_edges)
{
	struct gl gl = gl_open();
	struct scene *s;

	vertices(&gl, GL_QUADS, 4);
	gl_call(&gl, "glEnable", "e", GL_BLEND);
	gl_call(&gl, "glBegin", "e", GL_POLYGON);
	for (unsigned i = 0; i < 4; i++) {
		gl_call(&gl, "glEdgeFlag", "i", i != 1);
		gl_call(&gl, "glVertex2f", "ff", (double)i, 0.0);
	}
	gl_call(&gl, "glEnd", "");
	gl_call(&gl, "glEnable", "e", GL_FOG);
	gl_call(&gl, "glEdgeFlag", "i", 1);
	vertices(&gl, GL_TRIANGLE_STRIP, 4);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	/* 0 1 3: 0-1 and 3-0; 1 2 3: 1-2 and 2-3 */
	ck_assert_mem_eq(s->meshes[s->instances[0].mesh]->edge_flags, ((uint8_t[]){ 1 | 4, 1 | 2 | SCENE_CONTINUES }), 2);
	/* 1 2 0: 1-2 is off, 0-1 is on (vertex 0's flag applies to the edge that it starts); 2 3 0: 2-3 and 3-0 */
	ck_assert_mem_eq(s->meshes[s->instances[1].mesh]->edge_flags, ((uint8_t[]){ 4, 1 | 2 | SCENE_CONTINUES }), 2);
	ck_assert_ptr_null(s->meshes[s->instances[2].mesh]->edge_flags);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.7: a vertex has the attributes that were current when it was passed. */
START_TEST(test_varying)
{
	struct gl gl = gl_open();
	const struct scene_mesh *m;
	struct scene *s;

	gl_call(&gl, "glColor3f", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glNormal3f", "fff", 0.0, 1.0, 0.0);
	gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(&gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(&gl, "glColor4ub", "uuuu", 0u, 255u, 0u, 51u);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 1.0);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 1.0); /* after the last vertex: applies to no vertex, but is
	                                                    current from now on */
	gl_call(&gl, "glEnd", "");
	s = gl_swap(&gl);
	m = s->meshes[0];
	ck_assert_uint_eq(m->attributes, SCENE_HAS_COLOR);
	ck_assert_floats(12, m->color, 1, 0, 0, 1, 0, 1, 0, 0.2f, 0, 1, 0, 0.2f);
	ck_assert_floats(3, s->currents[s->instances[0].current].normal, 0, 1, 0);
	ck_assert_floats(4, gl_state(&gl)->a.current.attribute[GLS_ATTR_COLOR], 0, 0, 1, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A colour that is set to its own value, or after the last vertex, is constant; equal vertices share a mesh. */
START_TEST(test_constant_and_same_mesh)
{
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 3; i++) {
		gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
		gl_call(&gl, "glColor3f", "fff", (double)i, 0.0, 0.0);
		vertices(&gl, GL_TRIANGLES, 3);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->n_meshes, 1);
	ck_assert_uint_eq(s->meshes[0]->attributes, 0);
	ck_assert_uint_eq(s->n_currents, 3);
	ck_assert_floats(1, s->currents[s->instances[2].current].color, 2);
	ck_assert_floats(1, &s->instances[2].modelview[12], 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Runs separated only by attributes share a mesh; each Begin is a separate draw. */
START_TEST(test_merged_runs)
{
	struct gl gl = gl_open();
	struct scene *s;

	vertices(&gl, GL_TRIANGLES, 3);
	gl_call(&gl, "glColor3f", "fff", 0.0, 1.0, 0.0);
	vertices(&gl, GL_QUAD_STRIP, 4);
	vertices(&gl, GL_LINES, 2);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	vertices(&gl, GL_LINES, 2);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->meshes[s->instances[0].mesh]->primitive_count, 3);
	ck_assert_mem_eq(s->meshes[s->instances[0].mesh]->primitive_draw, ((uint32_t[]){ 0, 1, 1 }), 12);
	ck_assert_uint_eq(s->instances[0].draw, 1);
	ck_assert_uint_eq(s->instances[1].draw, 3);
	ck_assert_uint_eq(s->instances[1].first_primitive, 3);
	ck_assert_uint_eq(s->n_clears, 1);
	ck_assert_uint_eq(s->clears[0].before_instance, 2);
	ck_assert_uint_eq(s->clears[0].draw, 4);
	ck_assert_uint_eq(s->instances[2].draw, 5);
	ck_assert_uint_eq(s->n_draws, 5);
	ck_assert_str_eq(s->draws[4].call, "glClear");
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.6.3: calls that are invalid between Begin and End; sec. 2.5: they change nothing. */
START_TEST(test_errors)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnd", "");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glBegin", "e", 99u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(&gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(&gl, "glVertex2f", "ff", 1.0, 1.0);
	gl_call(&gl, "glEnd", "");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->materials[0].lighting, 0);
	ck_assert_floats(1, &s->instances[0].modelview[12], 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/*
 * A material between Begin and End: each vertex is lit with the one that was current when it was passed (sec. 2.6.3).
 */
START_TEST(test_material_inside)
{
	static const float red[4] = { 1, 0, 0, 1 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glBegin", "e", GL_TRIANGLE_STRIP);
	for (unsigned i = 0; i < 6; i++) {
		if (i == 3)
			gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT, GL_DIFFUSE, 4, red);
		gl_call(&gl, "glVertex2f", "ff", (double)i, 0.0);
	}
	gl_call(&gl, "glEnd", "");
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->meshes[0]->attributes, SCENE_HAS_FACE);
	for (unsigned i = 0; i < 6; i++) {
		ck_assert_floats(4, s->meshes[0]->face[i][0].diffuse, i < 3 ? 0.8f : 1, i < 3 ? 0.8f : 0, i < 3 ? 0.8f : 0, 1);
		ck_assert_floats(4, s->meshes[0]->face[i][1].diffuse, 0.8f, 0.8f, 0.8f, 1);
	}
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/*
 * Quads without indices that are smooth and completely in view are split from the first to the third vertex (Mesa
 * 22.3.6, llvmpipe); those of lists, flat ones and those to be clipped are not.
 */
START_TEST(test_turned_quads)
{
	static const uint32_t turned[6] = { 0, 1, 2, 0, 2, 3 }, not_turned[6] = { 0, 1, 3, 1, 2, 3 };

	for (unsigned how = 0; how < 4; how++) {
		struct gl gl = gl_open();
		const struct scene_mesh *mesh;
		struct scene *s;

		gl_call(&gl, "glScalef", "fff", how == 1 ? 1.0 : 0.25, 1.0, 1.0);
		gl_call(&gl, "glShadeModel", "e", how == 2 ? GL_FLAT : GL_SMOOTH);
		if (how == 3)
			gl_call(&gl, "glNewList", "ue", 1, GL_COMPILE_AND_EXECUTE);
		vertices(&gl, GL_QUADS, 4);
		if (how == 3) {
			gl_call(&gl, "glEndList", "");
			gl_call(&gl, "glCallList", "u", 1);
		}
		s = gl_swap(&gl);
		mesh = s->meshes[s->instances[s->n_instances - 1].mesh];
		ck_assert_mem_eq(mesh->index, how == 0 ? turned : not_turned, sizeof(turned));
		ck_assert_uint_eq(mesh->edge_flags[0], how == 0 ? 3 : 5);
		ck_assert_uint_eq(mesh->edge_flags[1], SCENE_CONTINUES | (how == 0 ? 6 : 3));
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

GL_TESTS("primitives", test_cut, test_provoking, test_turned_quads, test_edges, test_varying,
         test_constant_and_same_mesh, test_merged_runs, test_errors, test_material_inside)
