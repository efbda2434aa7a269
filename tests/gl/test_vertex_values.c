/*
 * Meaning of vertex data by type (GL 2.1 sec. 2.7, 2.8, 2.10, tables 2.4 and 2.9; ARB_vertex_type_2_10_10_10_rev; GL
 * 3.0 for half and OpenGL ES for fixed): in arrays, in calls, packed, and for rectangles.
 */
#include <math.h>

#include "tests/gl/gl.h"

static const uint32_t types[] = { GL_BYTE,         GL_UNSIGNED_BYTE, GL_SHORT,  GL_UNSIGNED_SHORT, GL_INT,
	                          GL_UNSIGNED_INT, GL_FLOAT,         GL_DOUBLE, GL_HALF_FLOAT,     GL_FIXED };

enum { N_TYPES = sizeof(types) / sizeof(types[0]) };

/* value: not 0 */
static uint8_t *put(uint8_t *p, uint32_t type, double value)
{
	const int64_t whole = (int64_t)(type == GL_FIXED ? value * 65536 : value);
	const float number = (float)value;
	int power;
	const double fraction = frexp(value, &power);
	const uint16_t half = (uint16_t)((power + 14) << 10 | (int)(2048 * fraction - 1024));

	switch (type) {
	case GL_BYTE: case GL_UNSIGNED_BYTE: memcpy(p, &whole, 1); return p + 1;
	case GL_SHORT: case GL_UNSIGNED_SHORT: memcpy(p, &whole, 2); return p + 2;
	case GL_FLOAT: memcpy(p, &number, 4); return p + 4;
	case GL_DOUBLE: memcpy(p, &value, 8); return p + 8;
	case GL_HALF_FLOAT: memcpy(p, &half, 2); return p + 2;
	default: memcpy(p, &whole, 4); return p + 4;
	}
}

/* Positions are used unchanged, in every type; integer colours are mapped to [0,1] or [-1,1], with 0 representable
 * in arrays (gls_geometry). */
START_TEST(test_arrays)
{
	/* for each type, the number that means 1, one in between, and its meaning */
	static const double colors[N_TYPES][3] = {
		{ 127, 25, 25.0 / 127 }, { 255, 51, 0.2 }, { 32767, -1, -1.0 / 32767 }, { 65535, 13107, 0.2 },
		{ 2147483647, 1073741823, 0.5 }, { 4294967295, 858993459, 0.2 }, { 1, 0.25, 0.25 }, { 1, 0.125, 0.125 },
		{ 1, 0.5, 0.5 }, { 1, 0.75, 0.75 },
	};

	for (unsigned i = 0; i < N_TYPES; i++) {
		struct gl gl = gl_open();
		uint8_t places[3 * 3 * 8], shades[3 * 4 * 8], *place = places, *shade = shades;
		struct scene *s;

		for (unsigned k = 0; k < 9; k++)
			place = put(place, types[i], k + 1);
		for (unsigned k = 0; k < 12; k++)
			shade = put(shade, types[i], colors[i][k % 2]);
		gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
		gl_call(&gl, "glVertexPointer", "ieib", 3, types[i], 0, (size_t)(place - places), places);
		gl_call(&gl, "glEnableClientState", "e", GL_COLOR_ARRAY);
		gl_call(&gl, "glColorPointer", "ieib", 4, types[i], 0, (size_t)(shade - shades), shades);
		gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, 3);
		s = gl_swap(&gl);
		ck_assert_msg(s->n_instances == 1, "type %#x is not drawn", types[i]);
		ck_assert_floats(12, s->meshes[0]->position, 1, 2, 3, 1, 4, 5, 6, 1, 7, 8, 9, 1);
		for (unsigned k = 0; k < 12; k++)
			ck_assert_msg(fabs(s->meshes[0]->color[k] - (k % 2 ? colors[i][2] : 1)) < 1e-6,
			              "type %#x, colour %u: %g", types[i], k, s->meshes[0]->color[k]);
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

struct value {
	const char *call, *letters;
	uint32_t args[4];
	unsigned attribute;
	float wanted[4];
};

#define X1 (1u | 2u << 10 | 3u << 20)
#define SIGNED GL_INT_2_10_10_10_REV
#define UNSIGNED GL_UNSIGNED_INT_2_10_10_10_REV

static const struct value values[] = {
	{ "glColor3b", "iii", { -128, 0, 127 }, GLS_ATTR_COLOR, { -1, 1 / 255.0f, 1, 1 } },
	{ "glColor4b", "iiii", { 127, 25, 127, -128 }, GLS_ATTR_COLOR, { 1, 0.2f, 1, -1 } },
	{ "glColor3ub", "uuu", { 0, 51, 255 }, GLS_ATTR_COLOR, { 0, 0.2f, 1, 1 } },
	{ "glColor4ub", "uuuu", { 255, 102, 0, 51 }, GLS_ATTR_COLOR, { 1, 0.4f, 0, 0.2f } },
	{ "glColor3s", "iii", { -32768, 32767, 0 }, GLS_ATTR_COLOR, { -1, 1, 1 / 65535.0f, 1 } },
	{ "glColor4us", "uuuu", { 0, 13107, 65535, 26214 }, GLS_ATTR_COLOR, { 0, 0.2f, 1, 0.4f } },
	{ "glColor3i", "iii", { 0x7fffffff, 0x80000000u, 0x3fffffff }, GLS_ATTR_COLOR, { 1, -1, 0.5f, 1 } },
	{ "glColor4ui", "uuuu", { 0, 0xffffffffu, 0x33333333u, 0x66666666u }, GLS_ATTR_COLOR, { 0, 1, 0.2f, 0.4f } },
	{ "glSecondaryColor3ub", "uuu", { 255, 51, 0 }, GLS_ATTR_SECONDARY, { 1, 0.2f, 0, 1 } },
	{ "glSecondaryColor3s", "iii", { -32768, 32767, 0 }, GLS_ATTR_SECONDARY, { -1, 1, 1 / 65535.0f, 1 } },
	{ "glNormal3b", "iii", { -128, 0, 127 }, GLS_ATTR_NORMAL, { -1, 1 / 255.0f, 1, 1 } },
	{ "glNormal3i", "iii", { 0x80000000u, 0x7fffffff, 0x3fffffff }, GLS_ATTR_NORMAL, { -1, 1, 0.5f, 1 } },
	{ "glTexCoord1i", "i", { -3 }, GLS_ATTR_TEXCOORD, { -3, 0, 0, 1 } },
	{ "glTexCoord2s", "ii", { 5, -6 }, GLS_ATTR_TEXCOORD, { 5, -6, 0, 1 } },
	{ "glTexCoord4i", "iiii", { 1, 2, 3, 4 }, GLS_ATTR_TEXCOORD, { 1, 2, 3, 4 } },
	{ "glMultiTexCoord3i", "eiii", { GL_TEXTURE0 + 2, 7, 8, 9 }, GLS_ATTR_TEXCOORD + 2, { 7, 8, 9, 1 } },
	/* packed: coordinates are unchanged, other attributes are normalized; missing components are 0 0 0 1 */
	{ "glTexCoordP2ui", "eu", { UNSIGNED, X1 }, GLS_ATTR_TEXCOORD, { 1, 2, 0, 1 } },
	{ "glTexCoordP4ui", "eu", { SIGNED, X1 | 1023u | 2u << 30 }, GLS_ATTR_TEXCOORD, { -1, 2, 3, -2 } },
	{ "glTexCoordP1ui", "eu", { SIGNED, 512 }, GLS_ATTR_TEXCOORD, { -512, 0, 0, 1 } },
	{ "glMultiTexCoordP3ui", "eeu", { GL_TEXTURE0 + 3, UNSIGNED, X1 | 1023u }, GLS_ATTR_TEXCOORD + 3, { 1023, 2, 3, 1 } },
	{ "glNormalP3ui", "eu", { SIGNED, 511 | 512u << 10 | 1023u << 20 }, GLS_ATTR_NORMAL, { 1, -1, -1 / 511.0f, 1 } },
	{ "glColorP3ui", "eu", { UNSIGNED, 1023 | 341u << 10 }, GLS_ATTR_COLOR, { 1, 1 / 3.0f, 0, 1 } },
	{ "glColorP4ui", "eu", { UNSIGNED, 1023 | 341u << 10 | 2u << 30 }, GLS_ATTR_COLOR, { 1, 1 / 3.0f, 0, 2 / 3.0f } },
	{ "glColorP4ui", "eu", { SIGNED, 511 | 1u << 30 }, GLS_ATTR_COLOR, { 1, 0, 0, 1 } },
	{ "glSecondaryColorP3ui", "eu", { UNSIGNED, 341u << 20 }, GLS_ATTR_SECONDARY, { 0, 0, 1 / 3.0f, 1 } },
};

/* Empty Mesa's vertex store (replay/gl/geometry/waiting.h): afterwards missing components are filled in. */
static void empty_store(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_POINTS);
	gl_call(gl, "glEnd", "");
	gl_call(gl, "glEnable", "e", GL_BLEND);
	gl_call(gl, "glDisable", "e", GL_BLEND);
}

START_TEST(test_calls)
{
	struct gl gl = gl_open();

	for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
		const struct value *v = &values[i];
		const float *have = gl_state(&gl)->a.current.attribute[v->attribute];
		const unsigned n = v->attribute == GLS_ATTR_NORMAL || v->attribute == GLS_ATTR_SECONDARY ? 3 : 4;

		empty_store(&gl);
		gl_call(&gl, v->call, v->letters, v->args[0], v->args[1], v->args[2], v->args[3]);
		ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
		for (unsigned k = 0; k < n; k++)
			ck_assert_msg(fabsf(have[k] - v->wanted[k]) < 1e-6f, "row %zu, %s, number %u: %g, not %g", i,
			              v->call, k, have[k], v->wanted[k]);
	}
	gl_call(&gl, "glColorP4ui", "eu", GL_UNSIGNED_INT, 5u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

static float alpha_now(struct gl *gl)
{
	return gl_state(gl)->a.current.attribute[GLS_ATTR_COLOR][3];
}

/* In Mesa the last components persist after being cut off; in lists, and in other implementations, they never do. */
START_TEST(test_components)
{
	struct gl gl = gl_open();

	for (int other = 0; other < 2; other++) {
		if (other)
			gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:gl 4.6.0 NVIDIA 535.54, GeForce");
		empty_store(&gl);
		gl_call(&gl, "glColor4f", "ffff", 1.0, 1.0, 1.0, 0.25);
		gl_call(&gl, "glColor3f", "fff", 1.0, 1.0, 1.0);
		ck_assert_float_eq(alpha_now(&gl), 1);
		gl_call(&gl, "glColor4f", "ffff", 1.0, 1.0, 1.0, 0.5);
		gl_call(&gl, "glColor3f", "fff", 1.0, 1.0, 1.0);
		ck_assert_float_eq(alpha_now(&gl), other ? 1 : 0.5f);
		gl_call(&gl, "glColor3ub", "uuu", 255, 255, 255); /* glColor4f in Mesa (tests/real/small/kept.c) */
		ck_assert_float_eq(alpha_now(&gl), 1);
		empty_store(&gl);
		gl_call(&gl, "glColor3f", "fff", 1.0, 1.0, 1.0);
		ck_assert_float_eq(alpha_now(&gl), 1);
		gl_call(&gl, "glNewList", "ue", 1, GL_COMPILE);
		for (int i = 0; i < 2; i++) {
			gl_call(&gl, "glColor4f", "ffff", 1.0, 1.0, 1.0, 0.5);
			gl_call(&gl, "glColor3f", "fff", 1.0, 1.0, 1.0);
		}
		gl_call(&gl, "glEndList", "");
		gl_call(&gl, "glCallList", "u", 1);
		ck_assert_float_eq(alpha_now(&gl), 1);
	}
	gl_close(&gl);
}
END_TEST

/* Positions in three kinds of calls, the last one packed. */
START_TEST(test_places)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(&gl, "glVertex2i", "ii", -7, 8);
	gl_call(&gl, "glVertexP2ui", "eu", SIGNED, 1023u | 5u << 10 | 6u << 20);
	gl_call(&gl, "glVertexP4ui", "eu", UNSIGNED, X1 | 3u << 30);
	gl_call(&gl, "glEnd", "");
	s = gl_swap(&gl);
	ck_assert_floats(12, s->meshes[0]->position, -7, 8, 0, 1, -1, 5, 0, 1, 1, 2, 3, 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Corners of a rectangle, passed one by one or as arrays. */
START_TEST(test_rectangles)
{
	static const float floats[2][2] = { { 1, 2 }, { 3, 4 } };
	static const double doubles[2][2] = { { 1, 2 }, { 3, 4 } };
	static const uint32_t whole[2][2] = { { 1, 2 }, { 3, 4 } };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glRectf", "ffff", 1.0, 2.0, 3.0, 4.0);
	gl_call(&gl, "glRectd", "dddd", 1.0, 2.0, 3.0, 4.0);
	gl_call(&gl, "glRecti", "iiii", 1, 2, 3, 4);
	gl_call(&gl, "glRects", "iiii", 1, 2, 3, 4);
	gl_call(&gl, "glRectfv", "FF", 2, floats[0], 2, floats[1]);
	gl_call(&gl, "glRectdv", "DD", 2, doubles[0], 2, doubles[1]);
	gl_call(&gl, "glRectiv", "UU", 2, whole[0], 2, whole[1]);
	gl_call(&gl, "glRectsv", "UU", 2, whole[0], 2, whole[1]);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 8);
	for (uint32_t i = 0; i < 8; i++)
		ck_assert_floats(16, s->meshes[s->instances[i].mesh]->position, 1, 2, 0, 1, 3, 2, 0, 1, 3, 4, 0, 1, 1, 4, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("vertex values", test_arrays, test_calls, test_components, test_places, test_rectangles)
