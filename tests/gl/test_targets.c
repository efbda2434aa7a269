/* What is drawn to (GL 2.1 sec. 4, GLX 1.4 sec. 3.3.3): how many bits it has. */
#include "tests/gl/gl.h"

static void triangle(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 0.0, 1.0);
	gl_call(gl, "glEnd", "");
}

static void current_with(struct gl *gl, uint64_t handle, uint64_t visual)
{
	gl_call_address(gl, handle, "glXCreateContext", "pppi", (uint64_t)1, visual, (uint64_t)0, 1);
	gl_call(gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, handle);
}

/* What the program asked of a visual, or of the one that it chose, holds for contexts made of it. */
START_TEST(test_bits_of_visuals)
{
	const uint32_t with[] = { 4, 5, 11, 1, 12, 1, 0 }, without[] = { 4, 12, 11, 0 }; /* 11: a depth size, not the token */
	const uint32_t eight = 8, sixteen = 16, zero = 0;
	struct gl gl = gl_open();

	gl_call_address(&gl, 0x100, "glXChooseVisual", "piU", (uint64_t)1, 0, 7, with);
	gl_call_address(&gl, 0x200, "glXChooseVisual", "piU", (uint64_t)1, 0, 4, without);
	gl_call(&gl, "glXGetConfig", "ppiU", (uint64_t)1, (uint64_t)0x200, 12, 1, &sixteen);
	gl_call(&gl, "glXGetConfig", "ppiU", (uint64_t)1, (uint64_t)0x200, 13, 1, &zero);
	gl_call(&gl, "eglGetConfigAttrib", "ppiU", (uint64_t)1, (uint64_t)0x300, 0x3021, 1, &eight);
	current_with(&gl, 0x11, 0x100);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 8);
	ck_assert_uint_eq(gl_state(&gl)->depth_bits, 24);
	current_with(&gl, 0x12, 0x200);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 0);
	ck_assert_uint_eq(gl_state(&gl)->depth_bits, 16);
	ck_assert_uint_eq(gl_state(&gl)->stencil_bits, 0);
	gl_call_address(&gl, 0x13, "eglCreateContext", "pppp", (uint64_t)1, (uint64_t)0x300, (uint64_t)0, (uint64_t)0);
	gl_call(&gl, "eglMakeCurrent", "pppp", (uint64_t)1, (uint64_t)7, (uint64_t)7, (uint64_t)0x13);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 8);
	gl_close(&gl);
}
END_TEST

/* What our recorder marks counts more; without a depth or stencil buffer their tests are off (sec. 4.1.5, 4.1.6). */
START_TEST(test_bits_of_marker)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	gl_call(&gl, "glEnable", "e", GL_STENCIL_TEST);
	triangle(&gl);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 0 0");
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->alpha_bits, 8);
	ck_assert_uint_eq(s->depth_bits, 0);
	ck_assert_uint_eq(s->stencil_bits, 0);
	ck_assert_uint_eq(s->materials[s->instances[0].material].depth_test, 1);
	ck_assert_uint_eq(s->materials[s->instances[1].material].depth_test, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].stencil_test, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("targets", test_bits_of_visuals, test_bits_of_marker)
