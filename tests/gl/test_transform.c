/* Matrices, stacks, viewport, clip planes, light positions (GL 2.1 sec. 2.11, 2.12, 2.14). */
#include <math.h>

#include "base/mat4.h"
#include "tests/gl/gl.h"

static const float *modelview(struct gl *gl)
{
	return gl_state(gl)->modelview.matrices[gl_state(gl)->modelview.depth];
}

/* Sec. 2.11.2: each call multiplies from the right. */
START_TEST(test_products)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glTranslatef", "fff", 1.0, 2.0, 3.0);
	gl_call(&gl, "glRotatef", "ffff", 90.0, 0.0, 0.0, 2.0);
	gl_call(&gl, "glScaled", "ddd", 2.0, 3.0, 4.0);
	ck_assert_floats(16, modelview(&gl), 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1);
	gl_call(&gl, "glLoadTransposeMatrixf", "F", 16, modelview(&gl));
	ck_assert_floats(4, modelview(&gl), 0, -3, 0, 1);
	gl_call(&gl, "glLoadIdentity", "");
	ck_assert_floats(16, modelview(&gl), 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
	gl_close(&gl);
}
END_TEST

/* Equations of Frustum and Ortho; invalid arguments are INVALID_VALUE and change nothing. */
START_TEST(test_projections)
{
	struct gl gl = gl_open();
	const float *p;

	gl_call(&gl, "glMatrixMode", "e", GL_PROJECTION);
	gl_call(&gl, "glFrustum", "dddddd", -1.0, 1.0, -1.0, 1.0, 5.0, 60.0);
	p = gl_state(&gl)->projection.matrices[0];
	ck_assert_floats(16, p, 5, 0, 0, 0, 0, 5, 0, 0, 0, 0, -65.0f / 55, -1, 0, 0, -600.0f / 55, 0);
	gl_call(&gl, "glFrustum", "dddddd", -1.0, 1.0, -1.0, 1.0, -5.0, 60.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glOrtho", "dddddd", 0.0, 0.0, 0.0, 1.0, -1.0, 1.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	ck_assert_floats(1, p, 5);
	gl_call(&gl, "glLoadIdentity", "");
	gl_call(&gl, "glOrtho", "dddddd", 0.0, 4.0, 0.0, 2.0, -1.0, 1.0);
	ck_assert_floats(16, p, 0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, -1, -1, 0, 1);
	ck_assert_floats(1, modelview(&gl), 1);
	gl_close(&gl);
}
END_TEST

START_TEST(test_stacks)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glPopMatrix", "");
	ck_assert_uint_eq(gl_error(&gl), GL_STACK_UNDERFLOW);
	for (unsigned i = 0; i < 40; i++)
		gl_call(&gl, "glPushMatrix", "");
	ck_assert_uint_eq(gl_error(&gl), GL_STACK_OVERFLOW);
	gl_call(&gl, "glTranslatef", "fff", 9.0, 0.0, 0.0);
	gl_call(&gl, "glPopMatrix", "");
	ck_assert_floats(1, modelview(&gl) + 12, 0);
	gl_call(&gl, "glMatrixMode", "e", GL_TEXTURE);
	gl_call(&gl, "glActiveTexture", "e", GL_TEXTURE1);
	gl_call(&gl, "glTranslatef", "fff", 5.0, 0.0, 0.0);
	ck_assert_floats(1, gl_state(&gl)->texture[1].matrices[0] + 12, 5);
	ck_assert_floats(1, gl_state(&gl)->texture[0].matrices[0] + 12, 0);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.12, 2.14.1: planes and lights are transformed to eye space when they are set. */
START_TEST(test_eye_space)
{
	static const double plane[4] = { 0, 1, 0, -2 };
	static const float light[4] = { 1, 2, 3, 1 }, down[4] = { 0, 0, -1, 0 };
	struct gl gl = gl_open();

	gl_call(&gl, "glTranslatef", "fff", 0.0, 10.0, 0.0);
	gl_call(&gl, "glRotatef", "ffff", 90.0, 0.0, 0.0, 1.0);
	gl_call(&gl, "glClipPlane", "eD", GL_CLIP_PLANE1, 4, plane);
	gl_call(&gl, "glLightfv", "eeF", GL_LIGHT3, GL_POSITION, 4, light);
	gl_call(&gl, "glLightfv", "eeF", GL_LIGHT3, GL_SPOT_DIRECTION, 3, down);
	gl_call(&gl, "glLoadIdentity", "");
	/* y = 2 before is x = -2 after the quarter turn, for any translation along y */
	ck_assert_floats(4, gl_state(&gl)->a.transform.clip_plane_eye[1], -1, 0, 0, -2);
	ck_assert_floats(4, gl_state(&gl)->a.lighting.lights[3].value.position_eye, -2, 11, 3, 1);
	ck_assert_floats(3, gl_state(&gl)->a.lighting.lights[3].value.spot_direction_eye, 0, 0, -1);
	gl_call(&gl, "glClipPlane", "eD", GL_CLIP_PLANE0 + 8, 4, plane);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

static uint32_t space_of(const struct scene *s, unsigned instance)
{
	return s->views[s->instances[instance].view].space;
}

/*
 * Views: equal ones are stored once; with equal viewport rectangles, perspective views share their eye space, as do
 * parallel ones with the same x and y; scissors are clipped to the target.
 */
START_TEST(test_views)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_SCISSOR_TEST);
	for (unsigned i = 0; i < 7; i++) {
		gl_call(&gl, "glViewport", "iiii", i == 3 ? 32 : 0, 0, 32, 64);
		gl_call(&gl, "glScissor", "iiii", -10, 50, 40, 100);
		gl_call(&gl, "glMatrixMode", "e", GL_PROJECTION);
		gl_call(&gl, "glLoadIdentity", "");
		if (i == 4 || i == 5)
			gl_call(&gl, "glFrustum", "dddddd", -1.0, 1.0, -1.0, i - 3.0, 1.0, 10.0 * i);
		else
			gl_call(&gl, "glOrtho", "dddddd", 0.0, i == 2 ? 2.0 : 1.0, 0.0, 1.0, -1.0, i == 6 ? 5.0 : 1.0);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->width, 64);
	ck_assert_uint_eq(s->n_instances, 7);
	ck_assert_uint_eq(s->n_views, 6);
	for (unsigned i = 1; i < 4; i++)
		ck_assert_uint_eq(s->instances[i].mesh, s->instances[0].mesh);
	ck_assert_uint_eq(s->instances[0].view, s->instances[1].view);
	ck_assert_uint_ne(space_of(s, 2), space_of(s, 0));
	ck_assert_uint_ne(space_of(s, 3), space_of(s, 0));
	ck_assert_uint_ne(space_of(s, 4), space_of(s, 0));
	ck_assert_uint_eq(space_of(s, 5), space_of(s, 4));
	ck_assert_uint_eq(space_of(s, 6), space_of(s, 0));
	ck_assert_mem_eq(s->views[0].scissor, ((int32_t[]){ 0, 50, 30, 14 }), 16);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* The drawable's size: guessed from viewports, until our recorder's marker gives it. */
START_TEST(test_drawable)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glViewport", "iiii", 0, 0, 320, 32);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->width, 320);
	ck_assert_uint_eq(s->height, 64);
	scene_release(&s);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:drawable 200 100");
	gl_call(&gl, "glViewport", "iiii", 0, 0, 4000, 4000);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->width, 200);
	ck_assert_uint_eq(s->height, 100);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_inverse)
{
	const float m[16] = { 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1 }, singular[16] = { 1 };
	float inverse[16], product[16];

	ck_assert_int_eq(mat4_invert(inverse, m), 1);
	mat4_mul(product, m, inverse);
	ck_assert_floats(16, product, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
	ck_assert_int_eq(mat4_invert(inverse, singular), 0);
}
END_TEST

/*
 * A sum rounded to float after each operation loses two small terms one after the other; the x87 rounds the whole sum
 * once.
 */
START_TEST(test_sums)
{
	const float small = 0x1p-24f, sum[] = { 1, 1 + 0x1p-23f };
	const float m[16] = { 1, 0, 0, 0, small, 1, 0, 0, small, 0, 1, 0, 0, 0, 0, 1 }, ones[16] = { 1, 1, 1 };
	/* -(far + near) / (far - near), computed with rational numbers */
	const float depth[] = { -0x1.07a4ep0f, -0x1.07a4dep0f };

	for (int x87 = 0; x87 < 2; x87++) {
		struct gl gl = gl_open();

		if (x87)
			gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:x87");
		gl_call(&gl, "glLoadMatrixf", "F", 16, m);
		gl_call(&gl, "glMultMatrixf", "F", 16, ones);
		ck_assert_float_eq(modelview(&gl)[0], sum[x87]);
		gl_call(&gl, "glLoadMatrixf", "F", 16, m);
		gl_call(&gl, "glTranslatef", "fff", 1.0, 1.0, 1.0);
		ck_assert_float_eq(modelview(&gl)[12], sum[x87]);
		gl_call(&gl, "glLoadMatrixf", "F", 16, m);
		gl_call(&gl, "glLightfv", "eeF", GL_LIGHT0, GL_POSITION, 4, ones);
		ck_assert_float_eq(gl_state(&gl)->a.lighting.lights[0].value.position_eye[0], sum[x87]);
		gl_call(&gl, "glLoadIdentity", "");
		gl_call(&gl, "glFrustum", "dddddd", -1.0, 1.0, -1.0, 1.0, (double)5.1f, (double)346.7f);
		ck_assert_float_eq(modelview(&gl)[10], depth[x87]);
		gl_close(&gl);
	}
}
END_TEST

GL_TESTS("transform", test_products, test_projections, test_stacks, test_eye_space, test_views, test_drawable,
         test_inverse, test_sums)
