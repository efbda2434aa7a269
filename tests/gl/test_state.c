/* Attribute stacks, materials, contexts, and the state that a draw uses (GL 2.1 sec. 2.14.3, 6.1.14; GLX 1.4 sec.
 * 3.3). */
#include <math.h>

#include "tests/gl/gl.h"

static void draw(struct gl *gl)
{
	gl_call(gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
}

/* State in the pushed groups is restored, other state is kept. */
START_TEST(test_push_attrib)
{
	struct gl gl = gl_open();
	struct gls_attribs *a = &gl_state(&gl)->a;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glPushAttrib", "m", GL_ENABLE_BIT | GL_DEPTH_BUFFER_BIT);
	gl_call(&gl, "glDisable", "e", GL_LIGHTING);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glEnable", "e", GL_LIGHT2);
	gl_call(&gl, "glEnable", "e", GL_CLIP_PLANE3);
	gl_call(&gl, "glDepthFunc", "e", GL_ALWAYS);
	gl_call(&gl, "glShadeModel", "e", GL_FLAT);
	gl_call(&gl, "glPopAttrib", "");
	ck_assert_uint_eq(a->lighting.enabled, 1);
	ck_assert_uint_eq(a->texturing.units[0].enabled, 0);
	ck_assert_uint_eq(a->lighting.lights[2].enabled, 0);
	ck_assert_uint_eq(a->transform.clip_plane_mask, 0);
	ck_assert_uint_eq(a->depth.func, GL_LESS);
	ck_assert_uint_eq(a->lighting.shade_model, GL_FLAT);
	gl_call(&gl, "glPopAttrib", "");
	ck_assert_uint_eq(gl_error(&gl), GL_STACK_UNDERFLOW);
	for (unsigned i = 0; i < 17; i++)
		gl_call(&gl, "glPushAttrib", "m", GL_ALL_ATTRIB_BITS);
	ck_assert_uint_eq(gl_error(&gl), GL_STACK_OVERFLOW);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.5: the first error sticks until it is queried; the call that caused it changed nothing. */
START_TEST(test_first_error)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glLineWidth", "f", -1.0);
	gl_call(&gl, "glEnable", "e", 1u);
	ck_assert_floats(1, &gl_state(&gl)->a.line.width, 1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.14.3: a tracked parameter follows the colour, cannot be set, and keeps the last colour when tracking ends. */
START_TEST(test_color_material)
{
	static const float white[4] = { 1, 1, 1, 1 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glColorMaterial", "ee", GL_FRONT, GL_DIFFUSE);
	gl_call(&gl, "glEnable", "e", GL_COLOR_MATERIAL);
	gl_call(&gl, "glColor3f", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT_AND_BACK, GL_DIFFUSE, 4, white);
	draw(&gl);
	gl_call(&gl, "glColor3f", "fff", 0.0, 1.0, 0.0);
	draw(&gl);
	gl_call(&gl, "glDisable", "e", GL_COLOR_MATERIAL);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 1.0);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_floats(3, s->materials[s->instances[0].material].front.diffuse, 1, 0, 0);
	ck_assert_floats(3, s->materials[s->instances[0].material].back.diffuse, 1, 1, 1);
	ck_assert_uint_eq(s->materials[s->instances[0].material].color_material, GL_FRONT);
	ck_assert_floats(3, s->materials[s->instances[1].material].front.diffuse, 0, 1, 0);
	ck_assert_floats(3, s->materials[s->instances[2].material].front.diffuse, 0, 1, 0);
	ck_assert_uint_eq(s->materials[s->instances[2].material].color_material, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Pending vertices are drawn with the state they were passed under; equal states share a material. */
START_TEST(test_state_at_draw)
{
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 3; i++) {
		draw(&gl);
		gl_call(&gl, i & 1 ? "glDisable" : "glEnable", "e", GL_BLEND);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->n_materials, 2);
	ck_assert_uint_eq(s->materials[s->instances[0].material].blend, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].blend, 1);
	ck_assert_uint_eq(s->instances[2].material, s->instances[0].material);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Lights: only enabled ones, in order; each group is stored once. */
START_TEST(test_lights)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glEnable", "e", GL_LIGHT5);
	gl_call(&gl, "glEnable", "e", GL_LIGHT0);
	draw(&gl);
	gl_call(&gl, "glDepthMask", "i", 0);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_materials, 2);
	ck_assert_uint_eq(s->n_lights, 2);
	ck_assert_uint_eq(s->lights[0].index, 0);
	ck_assert_floats(3, s->lights[0].diffuse, 1, 1, 1);
	ck_assert_uint_eq(s->lights[1].index, 5);
	ck_assert_floats(3, s->lights[1].diffuse, 0, 0, 0);
	ck_assert_uint_eq(s->materials[1].light_count, 2);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* needs_previous: drawing precedes the clear of the whole picture. */
START_TEST(test_needs_previous)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->needs_previous, 0);
	scene_release(&s);
	draw(&gl);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->needs_previous, 1);
	scene_release(&s);
	gl_call(&gl, "glEnable", "e", GL_SCISSOR_TEST);
	gl_call(&gl, "glScissor", "iiii", 0, 0, 10, 10);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->needs_previous, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Contexts: separate state, objects shared on request, one current context per thread. */
START_TEST(test_contexts)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glEnable", "e", GL_FOG);
	gl_call(&gl, "glEndList", "");
	gl_call_address(&gl, 0x20, "glXCreateContext", "pppi", (uint64_t)1, (uint64_t)0, (uint64_t)0x10, 1);
	gl_call_address(&gl, 0x30, "glXCreateContext", "pppi", (uint64_t)1, (uint64_t)0, (uint64_t)0, 1);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, (uint64_t)0x20);
	gl_call(&gl, "glCallList", "u", 1u);
	ck_assert_uint_eq(gl_state(&gl)->a.fog.enabled, 1);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, (uint64_t)0x30);
	gl_call(&gl, "glCallList", "u", 1u);
	ck_assert_uint_eq(gl_state(&gl)->a.fog.enabled, 0);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 0u, (uint64_t)0);
	gl_call(&gl, "glEnable", "e", GL_FOG); /* without a context: no effect */
	ck_assert_uint_eq(gl.x->without_context, 1);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, (uint64_t)0x10);
	ck_assert_uint_eq(gl_state(&gl)->a.fog.enabled, 0);
	gl_close(&gl);
}
END_TEST

/* Scenes outlive the machine. */
START_TEST(test_scene_outlives)
{
	struct gl gl = gl_open();
	struct scene *s;

	draw(&gl);
	s = gl_swap(&gl);
	gl_close(&gl);
	ck_assert_floats(4, s->meshes[0]->position, 0, 0, 0, 1);
	scene_release(&s);
	ck_assert_ptr_null(s);
}
END_TEST

/* rtBuildKdTreeEXT's marker: applies to frames with draws after it. */
START_TEST(test_kd_tree_marker)
{
	struct gl gl = gl_open();

	for (uint32_t frame = 0; frame < 4; frame++) {
		struct scene *s;

		if (frame == 1)
			gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:kdtree");
		draw(&gl);
		s = gl_swap(&gl);
		ck_assert_uint_eq(s->kd_tree, frame > 0);
		scene_release(&s);
	}
	gl_close(&gl);
}
END_TEST

/* rtMaterialEXT's marker. */
START_TEST(test_surface_marker)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:material glass 0.9 1.5");
	draw(&gl);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:material matte");
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_floats(3, &s->materials[0].surface.reflect, 0, 0.9f, 1.5f);
	ck_assert_floats(3, &s->materials[1].surface.reflect, 0, 0, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Every command of GL 1.0 - 2.1 is executed, excused or counted: none is silently ignored. */
START_TEST(test_every_command)
{
	struct gl gl = gl_open();
	unsigned n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++) {
		if (!gls_commands[i].core || gls_commands[i].kind || gls_commands[i].excuse)
			continue;
		gl_call(&gl, gls_commands[i].name, "");
		ck_assert_uint_eq(gl.x->counts.unsupported[i], 1);
		n++;
	}
	ck_assert_uint_eq(gl_unsupported(&gl), n);
	for (unsigned i = 1; i < n_gls_commands; i++)
		ck_assert_str_lt(gls_commands[i - 1].name, gls_commands[i].name);
	gl_close(&gl);
}
END_TEST

/* Any command without arguments, with wrong ones, twice, between Begin and End: no crash. */
START_TEST(test_nonsense)
{
	for (unsigned round = 0; round < 4; round++) {
		struct gl gl = gl_open();
		if (round == 3)
			gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE_AND_EXECUTE);
		for (unsigned i = 0; i < n_gls_commands; i++) {
			if (strncmp(gls_commands[i].name, "glXMake", 7) == 0 || strcmp(gls_commands[i].name, "eglMakeCurrent") == 0 ||
			    strcmp(gls_commands[i].name, "wglMakeCurrent") == 0)
				continue;
			if (round == 0)
				gl_call(&gl, gls_commands[i].name, "");
			else if (round == 1)
				gl_call(&gl, gls_commands[i].name, "ssssssss", "4", "x", "2", "", "1", "x", "5", "x");
			else
				gl_call(&gl, gls_commands[i].name, "iiiiiiii", -1, 3, 0xffff, 1 << 30, 2, -9, 1, 0);
			if (round == 2 && i % 7 == 0)
				gl_call(&gl, "glBegin", "e", i % 10);
		}
		gl_close(&gl);
	}
}
END_TEST

GL_TESTS("state", test_push_attrib, test_first_error, test_color_material, test_state_at_draw, test_lights,
         test_needs_previous, test_contexts, test_scene_outlives, test_surface_marker, test_kd_tree_marker,
         test_every_command, test_nonsense)
