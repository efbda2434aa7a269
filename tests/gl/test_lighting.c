/* Lights, materials and colours that track the current one (GL 2.1 sec. 2.14.1 to 2.14.3, table 2.10). */
#include <math.h>

#include "tests/gl/gl.h"

static const struct gls_lighting *lighting(struct gl *gl)
{
	return &gl_state(gl)->a.lighting;
}

/*
 * Positions and directions are transformed to eye space by the modelview matrix at the time they are set, in all three
 * axes.
 */
START_TEST(test_places)
{
	static const float own[16] = { 1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1 };
	struct gl gl = gl_open();
	const struct scene_light *light = &lighting(&gl)->lights[2].value;

	gl_call(&gl, "glLoadMatrixf", "F", 16, own);
	gl_call(&gl, "glLightfv", "eeF", GL_LIGHT0 + 2, GL_POSITION, 4, (const float[4]){ 1, 10, 100, 2 });
	gl_call(&gl, "glLightfv", "eeF", GL_LIGHT0 + 2, GL_SPOT_DIRECTION, 3, (const float[3]){ 1, 10, 100 });
	gl_call(&gl, "glLoadIdentity", "");
	ck_assert_floats(4, light->position_eye, 763, 876, 1089, 2);
	ck_assert_floats(3, light->spot_direction_eye, 741, 852, 1063);
	gl_close(&gl);
}
END_TEST

/* Parameters of a light, and values out of range. */
START_TEST(test_numbers)
{
	struct number {
		uint32_t name;
		float good, wrong;
		size_t at;
	};
	static const struct number numbers[] = {
		{ GL_SPOT_EXPONENT, 128, 128.5f, offsetof(struct scene_light, spot_exponent) },
		{ GL_SPOT_EXPONENT, 0, -0.5f, offsetof(struct scene_light, spot_exponent) },
		{ GL_SPOT_CUTOFF, 90, 90.5f, offsetof(struct scene_light, spot_cutoff_deg) },
		{ GL_SPOT_CUTOFF, 180, 179, offsetof(struct scene_light, spot_cutoff_deg) },
		{ GL_SPOT_CUTOFF, 0, -1, offsetof(struct scene_light, spot_cutoff_deg) },
		{ GL_CONSTANT_ATTENUATION, 0.5f, -0.5f, offsetof(struct scene_light, attenuation) },
		{ GL_LINEAR_ATTENUATION, 0.25f, -0.5f, offsetof(struct scene_light, attenuation) + 4 },
		{ GL_QUADRATIC_ATTENUATION, 0.125f, -0.5f, offsetof(struct scene_light, attenuation) + 8 },
	};
	struct gl gl = gl_open();
	const char *light = (const char *)&lighting(&gl)->lights[7].value;

	for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
		const struct number *n = &numbers[i];
		float have;

		gl_call(&gl, "glLightf", "eef", GL_LIGHT0 + 7, n->name, (double)n->good);
		ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
		gl_call(&gl, "glLightf", "eef", GL_LIGHT0 + 7, n->name, (double)n->wrong);
		ck_assert_msg(gl_error(&gl) == GL_INVALID_VALUE, "%g of %#x is accepted", n->wrong, n->name);
		memcpy(&have, light + n->at, sizeof(have));
		ck_assert_msg(have == n->good, "%#x is %g, not %g", n->name, have, n->good);
	}
	gl_call(&gl, "glLightf", "eef", GL_LIGHT0 + 8, GL_SPOT_CUTOFF, 10.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glLightf", "eef", GL_LIGHT0, GL_SHININESS, 10.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

/* Integers are mapped to colours by table 2.9, but positions and scalars are used unchanged. */
START_TEST(test_integers)
{
	static const uint32_t numbers[4] = { 0x7fffffff, 0, 0x1fffffff, 0x3fffffff };
	struct gl gl = gl_open();
	const struct gls_lighting *l = lighting(&gl);

	gl_call(&gl, "glLightiv", "eeU", GL_LIGHT0, GL_SPECULAR, 4, numbers);
	gl_call(&gl, "glLightiv", "eeU", GL_LIGHT0, GL_POSITION, 4, (const uint32_t[4]){ 1, 2, 3, 0 });
	gl_call(&gl, "glMaterialiv", "eeU", GL_FRONT, GL_EMISSION, 4, numbers);
	gl_call(&gl, "glMaterialiv", "eeU", GL_FRONT, GL_SHININESS, 1, (const uint32_t[1]){ 5 });
	gl_call(&gl, "glLightModeliv", "eU", GL_LIGHT_MODEL_AMBIENT, 4, numbers);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	ck_assert_floats(4, l->lights[0].value.specular, 1, 0, 0.25f, 0.5f);
	ck_assert_floats(4, l->lights[0].value.position_eye, 1, 2, 3, 0);
	ck_assert_floats(4, l->face[0].emission, 1, 0, 0.25f, 0.5f);
	ck_assert_float_eq(l->face[0].shininess, 5);
	ck_assert_floats(4, l->model_ambient, 1, 0, 0.25f, 0.5f);
	gl_close(&gl);
}
END_TEST

enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4, EMISSION = 8 };

/* Bit mask of a face's colours with this red. */
static unsigned with_red(const struct scene_face *face, float red)
{
	return (face->ambient[0] == red ? AMBIENT : 0) | (face->diffuse[0] == red ? DIFFUSE : 0) |
	       (face->specular[0] == red ? SPECULAR : 0) | (face->emission[0] == red ? EMISSION : 0);
}

/* Pending attributes become current with the next Begin (waiting.h). */
static void draw_nothing(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_POINTS);
	gl_call(gl, "glEnd", "");
}

/*
 * Sec. 2.14.3: colours selected by ColorMaterial track the current one from Enable on, and at once after a change of
 * mode; Material calls for them are ignored meanwhile. They keep their last value when tracking ends.
 */
START_TEST(test_color_material)
{
	static const struct { uint32_t mode; unsigned colors; } modes[] = {
		{ GL_AMBIENT, AMBIENT }, { GL_DIFFUSE, DIFFUSE }, { GL_SPECULAR, SPECULAR }, { GL_EMISSION, EMISSION },
		{ GL_AMBIENT_AND_DIFFUSE, AMBIENT | DIFFUSE },
	};
	static const uint32_t faces[] = { GL_FRONT, GL_BACK, GL_FRONT_AND_BACK };

	for (unsigned i = 0; i < 15; i++) {
		const uint32_t face = faces[i / 5], mode = modes[i % 5].mode;
		const unsigned colors[2] = { face == GL_BACK ? 0 : modes[i % 5].colors, face == GL_FRONT ? 0 : modes[i % 5].colors };
		struct gl gl = gl_open();
		const struct scene_face *have = lighting(&gl)->face;

		gl_call(&gl, "glColorMaterial", "ee", face == GL_BACK ? GL_FRONT : GL_BACK, GL_SPECULAR);
		gl_call(&gl, "glColor3f", "fff", 0.125, 0.0, 0.0);
		ck_assert_uint_eq(with_red(&have[0], 0.125f) | with_red(&have[1], 0.125f), 0);
		gl_call(&gl, "glColorMaterial", "ee", face, mode); /* no tracking yet */
		ck_assert_uint_eq(with_red(&have[0], 0.125f) | with_red(&have[1], 0.125f), 0);
		gl_call(&gl, "glEnable", "e", GL_COLOR_MATERIAL);
		for (unsigned side = 0; side < 2; side++)
			ck_assert_uint_eq(with_red(&have[side], 0.125f), colors[side]);
		gl_call(&gl, "glColor3f", "fff", 0.375, 0.0, 0.0);
		draw_nothing(&gl);
		for (unsigned k = 0; k < 4; k++)
			gl_call(&gl, "glMaterialfv", "eeF", GL_FRONT_AND_BACK, k == 3 ? GL_EMISSION : GL_AMBIENT + k, 4,
			        (const float[4]){ 0.625f, 0, 0, 1 });
		for (unsigned side = 0; side < 2; side++) {
			ck_assert_uint_eq(with_red(&have[side], 0.375f), colors[side]);
			ck_assert_uint_eq(with_red(&have[side], 0.625f), 15 & ~colors[side]);
		}
		gl_call(&gl, "glDisable", "e", GL_COLOR_MATERIAL);
		gl_call(&gl, "glColor3f", "fff", 0.875, 0.0, 0.0);
		ck_assert_uint_eq(with_red(&have[0], 0.375f), colors[0]);
		gl_close(&gl);
	}
}
END_TEST

START_TEST(test_color_material_changes)
{
	struct gl gl = gl_open();
	const struct scene_face *have = lighting(&gl)->face;

	gl_call(&gl, "glColor3f", "fff", 0.125, 0.0, 0.0);
	gl_call(&gl, "glColorMaterial", "ee", GL_BACK, GL_EMISSION);
	gl_call(&gl, "glEnable", "e", GL_COLOR_MATERIAL);
	gl_call(&gl, "glColorMaterial", "ee", GL_FRONT, GL_SPECULAR);
	ck_assert_uint_eq(with_red(&have[0], 0.125f), SPECULAR);
	gl_call(&gl, "glColor3f", "fff", 0.375, 0.0, 0.0);
	draw_nothing(&gl);
	ck_assert_uint_eq(with_red(&have[0], 0.375f), SPECULAR);
	ck_assert_uint_eq(with_red(&have[1], 0.125f), EMISSION);
	gl_call(&gl, "glColorMaterial", "ee", GL_LEFT, GL_SPECULAR);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glColorMaterial", "ee", GL_FRONT, GL_SHININESS);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glColor3f", "fff", 0.625, 0.0, 0.0);
	draw_nothing(&gl);
	ck_assert_uint_eq(with_red(&have[0], 0.625f), SPECULAR);
	gl_close(&gl);
}
END_TEST

GL_TESTS("lighting", test_places, test_numbers, test_integers, test_color_material, test_color_material_changes)
