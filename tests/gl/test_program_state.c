/*
 * State that assembly programs read (ARB_vertex_program sec. 2.14.1.2, tables X.2 and X.3; ARB_fragment_program table
 * X.3): each binding, as the constant in a draw's scene.
 */
#include <math.h>
#include <stdio.h>

#include "scene/program.h"
#include "tests/gl/gl.h"

static void set_light(struct gl *gl)
{
	static const float colors[3][4] = { { 0.1f, 0.2f, 0.3f, 0.4f },
		                            { 0.5f, 0.6f, 0.7f, 0.8f },
		                            { 0.9f, 0.25f, 0.75f, 0.125f } };
	static const uint32_t names[3] = { GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR };

	for (unsigned i = 0; i < 3; i++)
		gl_call(gl, "glLightfv", "eeF", GL_LIGHT0 + 1, names[i], 4, colors[i]);
	gl_call(gl, "glLightfv", "eeF", GL_LIGHT0 + 1, GL_POSITION, 4, (const float[4]){ 0, 3, 4, 0 });
	gl_call(gl, "glLightfv", "eeF", GL_LIGHT0 + 1, GL_SPOT_DIRECTION, 3, (const float[3]){ 0, 0, -2 });
	gl_call(gl, "glLightf", "eef", GL_LIGHT0 + 1, GL_SPOT_CUTOFF, 60.0);
	gl_call(gl, "glLightf", "eef", GL_LIGHT0 + 1, GL_SPOT_EXPONENT, 7.0);
	gl_call(gl, "glLightf", "eef", GL_LIGHT0 + 1, GL_CONSTANT_ATTENUATION, 1.5);
	gl_call(gl, "glLightf", "eef", GL_LIGHT0 + 1, GL_LINEAR_ATTENUATION, 0.25);
	gl_call(gl, "glLightf", "eef", GL_LIGHT0 + 1, GL_QUADRATIC_ATTENUATION, 0.125);
	gl_call(gl, "glLightModelfv", "eF", GL_LIGHT_MODEL_AMBIENT, 4, (const float[4]){ 0.5f, 0.25f, 0.125f, 0.75f });
}

static void set_material(struct gl *gl, uint32_t face, float scale)
{
	static const float colors[4][4] = { { 0.2f, 0.4f, 0.6f, 0.5f },
		                            { 0.1f, 0.3f, 0.5f, 0.7f },
		                            { 0.6f, 0.4f, 0.2f, 0.1f },
		                            { 0.05f, 0.1f, 0.15f, 0.3f } };
	static const uint32_t names[4] = { GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION };

	for (unsigned i = 0; i < 4; i++) {
		float color[4];

		for (unsigned k = 0; k < 4; k++)
			color[k] = scale * colors[i][k];
		gl_call(gl, "glMaterialfv", "eeF", face, names[i], 4, color);
	}
	gl_call(gl, "glMaterialf", "eef", face, GL_SHININESS, 20.0 * scale);
}

static void set_matrices(struct gl *gl)
{
	static const float own[16] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 };

	gl_call(gl, "glMatrixMode", "e", GL_PROJECTION);
	gl_call(gl, "glScalef", "fff", 1.0, 3.0, 5.0);
	gl_call(gl, "glMatrixMode", "e", GL_MATRIX0_ARB + 2);
	gl_call(gl, "glLoadMatrixf", "F", 16, own);
	gl_call(gl, "glMatrixMode", "e", GL_TEXTURE);
	gl_call(gl, "glTranslatef", "fff", 7.0, 8.0, 9.0);
	gl_call(gl, "glMatrixMode", "e", GL_MODELVIEW);
	gl_call(gl, "glTranslatef", "fff", 1.0, 2.0, 3.0);
	gl_call(gl, "glScalef", "fff", 2.0, 2.0, 2.0);
}

static void set_everything(struct gl *gl)
{
	static const double plane[4] = { 0.25, 0.5, 0.75, 1 };

	set_light(gl);
	set_material(gl, GL_FRONT, 1);
	set_material(gl, GL_BACK, 0.5f);
	gl_call(gl, "glActiveTexture", "e", GL_TEXTURE0 + 1);
	gl_call(gl, "glTexEnvfv", "eeF", GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 4, (const float[4]){ 0.2f, 0.3f, 0.4f, 0.6f });
	gl_call(gl, "glTexGenfv", "eeF", GL_T, GL_EYE_PLANE, 4, (const float[4]){ 1, 2, 3, 4 });
	gl_call(gl, "glTexGenfv", "eeF", GL_Q, GL_OBJECT_PLANE, 4, (const float[4]){ 5, 6, 7, 8 });
	gl_call(gl, "glFogfv", "eF", GL_FOG_COLOR, 4, (const float[4]){ 0.3f, 0.2f, 0.1f, 0.9f });
	gl_call(gl, "glFogf", "ef", GL_FOG_DENSITY, 0.5);
	gl_call(gl, "glFogf", "ef", GL_FOG_START, 2.0);
	gl_call(gl, "glFogf", "ef", GL_FOG_END, 10.0);
	gl_call(gl, "glClipPlane", "eD", GL_CLIP_PLANE0 + 3, 4, plane);
	gl_call(gl, "glPointSize", "f", 3.0);
	gl_call(gl, "glPointParameterf", "ef", GL_POINT_SIZE_MIN, 2.0);
	gl_call(gl, "glPointParameterf", "ef", GL_POINT_SIZE_MAX, 40.0);
	gl_call(gl, "glPointParameterf", "ef", GL_POINT_FADE_THRESHOLD_SIZE, 5.0);
	gl_call(gl, "glPointParameterfv", "eF", GL_POINT_DISTANCE_ATTENUATION, 3, (const float[3]){ 0.5f, 0.25f, 0.125f });
	gl_call(gl, "glDepthRange", "dd", 0.25, 0.75);
	set_matrices(gl);
	ck_assert_uint_eq(gl_error(gl), 0);
}

struct binding {
	const char *name;
	float wanted[4];
	uint32_t target;
};

static const struct binding bindings[] = {
	{ "material.ambient", { 0.2f, 0.4f, 0.6f, 0.5f }, GL_VERTEX_PROGRAM_ARB },
	{ "material.front.diffuse", { 0.1f, 0.3f, 0.5f, 0.7f }, GL_VERTEX_PROGRAM_ARB },
	{ "material.back.specular", { 0.3f, 0.2f, 0.1f, 0.05f }, GL_VERTEX_PROGRAM_ARB },
	{ "material.back.emission", { 0.025f, 0.05f, 0.075f, 0.15f }, GL_VERTEX_PROGRAM_ARB },
	{ "material.shininess", { 20, 0, 0, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "material.back.shininess", { 10, 0, 0, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].ambient", { 0.1f, 0.2f, 0.3f, 0.4f }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].diffuse", { 0.5f, 0.6f, 0.7f, 0.8f }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].specular", { 0.9f, 0.25f, 0.75f, 0.125f }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].position", { 0, 3, 4, 0 }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].attenuation", { 1.5f, 0.25f, 0.125f, 7 }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].spot.direction", { 0, 0, -1, 0.5f }, GL_VERTEX_PROGRAM_ARB },
	{ "light[1].half", { 0, 0.31622777f, 0.94868330f, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "lightmodel.ambient", { 0.5f, 0.25f, 0.125f, 0.75f }, GL_VERTEX_PROGRAM_ARB },
	{ "lightmodel.scenecolor", { 0.15f, 0.2f, 0.225f, 0.7f }, GL_VERTEX_PROGRAM_ARB },
	{ "lightmodel.back.scenecolor", { 0.075f, 0.1f, 0.1125f, 0.35f }, GL_VERTEX_PROGRAM_ARB },
	{ "lightprod[1].ambient", { 0.02f, 0.08f, 0.18f, 0.5f }, GL_VERTEX_PROGRAM_ARB },
	{ "lightprod[1].diffuse", { 0.05f, 0.18f, 0.35f, 0.7f }, GL_VERTEX_PROGRAM_ARB },
	{ "lightprod[1].back.specular", { 0.27f, 0.05f, 0.075f, 0.05f }, GL_VERTEX_PROGRAM_ARB },
	{ "fog.color", { 0.3f, 0.2f, 0.1f, 0.9f }, GL_VERTEX_PROGRAM_ARB },
	{ "fog.params", { 0.5f, 2, 10, 0.125f }, GL_VERTEX_PROGRAM_ARB },
	{ "texgen[1].eye.t", { 1, 2, 3, 4 }, GL_VERTEX_PROGRAM_ARB },
	{ "texgen[1].object.q", { 5, 6, 7, 8 }, GL_VERTEX_PROGRAM_ARB },
	{ "clip[3].plane", { 0.25f, 0.5f, 0.75f, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "point.size", { 3, 2, 40, 5 }, GL_VERTEX_PROGRAM_ARB },
	{ "point.attenuation", { 0.5f, 0.25f, 0.125f, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "texenv[1].color", { 0.2f, 0.3f, 0.4f, 0.6f }, GL_FRAGMENT_PROGRAM_ARB },
	{ "depth.range", { 0.25f, 0.75f, 0.5f, 1 }, GL_FRAGMENT_PROGRAM_ARB },
	{ "matrix.modelview.row[2]", { 0, 0, 2, 3 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.modelview.inverse.row[2]", { 0, 0, 0.5f, -1.5f }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.modelview.transpose.row[3]", { 1, 2, 3, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.modelview.invtrans.row[3]", { -0.5f, -1, -1.5f, 1 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.projection.row[1]", { 0, 3, 0, 0 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.mvp.row[2]", { 0, 0, 10, 15 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.texture[1].row[0]", { 1, 0, 0, 7 }, GL_VERTEX_PROGRAM_ARB },
	{ "matrix.program[2].row[1]", { 2, 6, 10, 14 }, GL_VERTEX_PROGRAM_ARB },
};

static void check_binding(const struct binding *b)
{
	struct gl gl = gl_open();
	const int is_vertex = b->target == GL_VERTEX_PROGRAM_ARB;
	const struct scene_material *m;
	const struct scene_program *head;
	const struct scene_program_light *lights;
	const float *constants;
	struct scene *s;
	char text[128];

	snprintf(text, sizeof(text), "!!ARB%cp1.0 PARAM p = state.%s; MOV result.%s, p; END", is_vertex ? 'v' : 'f', b->name,
	         is_vertex ? "position" : "color");
	set_everything(&gl);
	gl_call(&gl, "glProgramStringARB", "eeus", b->target, GL_PROGRAM_FORMAT_ASCII_ARB, (unsigned)strlen(text), text);
	gl_call(&gl, "glEnable", "e", b->target);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	m = &s->materials[s->instances[0].material];
	head = (const struct scene_program *)(s->programs + (is_vertex ? m->vertex_program : m->fragment_program) - 1);
	lights = (const struct scene_program_light *)((const struct scene_instruction *)(head + 1) + head->n_instructions);
	constants = (const float *)(lights + head->n_lights);
	for (unsigned k = 0; k < 4; k++)
		ck_assert_msg(fabsf(constants[k] - b->wanted[k]) <= 1e-5f, "state.%s[%u] is %g, not %g", b->name, k,
		              constants[k], b->wanted[k]);
	scene_release(&s);
	gl_close(&gl);
}

START_TEST(test_bindings)
{
	for (size_t i = 0; i < sizeof(bindings) / sizeof(bindings[0]); i++)
		check_binding(&bindings[i]);
}
END_TEST

GL_TESTS("program state", test_bindings)
