/*
 * Per-fragment operations of kernels/gl/pixel.h and blend.h at values that the specification gives (GL 2.1 sec. 4.1):
 * tests, stencil, blending, logic operations, and the resulting pixel. As in test_formulas, kernel and twin share this
 * text.
 */
#include <math.h>
#include <string.h>

#include "kernels/gl/stages.h"
#include "tests/case.h"

#define BITS_OF(depth, stencil, alpha) ((depth) | (stencil) << 8 | (alpha) << 16)
#define BUFFER_BITS BITS_OF(24u, 8u, 8u)

START_TEST(test_comparisons)
{
	static const struct { uint32_t func; int less, equal, greater; } rows[] = {
		{ GL_NEVER, 0, 0, 0 }, { GL_LESS, 1, 0, 0 }, { GL_EQUAL, 0, 1, 0 }, { GL_LEQUAL, 1, 1, 0 }, { GL_GREATER, 0, 0, 1 },
		{ GL_NOTEQUAL, 1, 0, 1 }, { GL_GEQUAL, 0, 1, 1 }, { GL_ALWAYS, 1, 1, 1 },
	};
	static const float ascending[] = { -INFINITY, -2, -1, -1e-30f, 0, 1e-30f, 0.5f, 1, 3, INFINITY };

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		ck_assert_int_eq(pixel_compare(rows[i].func, 4, 5), rows[i].less);
		ck_assert_int_eq(pixel_compare(rows[i].func, 5, 5), rows[i].equal);
		ck_assert_int_eq(pixel_compare(rows[i].func, 5, 4), rows[i].greater);
	}
	for (size_t i = 1; i < sizeof(ascending) / sizeof(ascending[0]); i++)
		ck_assert_uint_lt(pixel_order(ascending[i - 1]), pixel_order(ascending[i]));
	ck_assert_uint_eq(pixel_order(-0.0f), pixel_order(0));
}
END_TEST

START_TEST(test_stencil_operations)
{
	static const struct { uint32_t op, value, wanted; } rows[] = {
		{ GL_KEEP, 7, 7 }, { GL_ZERO, 7, 0 }, { GL_REPLACE, 7, 5 }, { GL_INCR, 7, 8 }, { GL_INCR, 255, 255 },
		{ GL_DECR, 7, 6 }, { GL_DECR, 0, 0 }, { GL_INVERT, 7, 248 }, { GL_INCR_WRAP, 7, 8 }, { GL_INCR_WRAP, 255, 0 },
		{ GL_DECR_WRAP, 7, 6 }, { GL_DECR_WRAP, 0, 255 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		ck_assert_uint_eq(pixel_stencil_apply(rows[i].op, rows[i].value, 5, 255, 8), rows[i].wanted);
		ck_assert_uint_eq(pixel_stencil_apply(rows[i].op, rows[i].value, 5, 0x3c, 8),
		                  (rows[i].value & 0xc3) | (rows[i].wanted & 0x3c));
	}
	ck_assert_uint_eq(pixel_stencil_apply(GL_INCR, 15, 0, 15, 4), 15);
	ck_assert_uint_eq(pixel_stencil_apply(GL_REPLACE, 0, 0x35, 255, 4), 5);
}
END_TEST

START_TEST(test_logic_operations)
{
	static const struct { uint32_t op, wanted; } rows[] = { /* for 1100 1100 over 1010 1010 */
		{ GL_CLEAR, 0 }, { GL_AND, 0x88 }, { GL_AND_REVERSE, 0x44 }, { GL_COPY, 0xcc }, { GL_AND_INVERTED, 0x22 },
		{ GL_NOOP, 0xaa }, { GL_XOR, 0x66 }, { GL_OR, 0xee }, { GL_NOR, 0x11 }, { GL_EQUIV, 0x99 }, { GL_INVERT, 0x55 },
		{ GL_OR_REVERSE, 0xdd }, { GL_COPY_INVERTED, 0x33 }, { GL_OR_INVERTED, 0xbb }, { GL_NAND, 0x77 }, { GL_SET, 0xff },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		ck_assert_float_eq(pixel_logic(rows[i].op, 0xcc / 255.0f, 0xaa / 255.0f), (float)rows[i].wanted / 255.0f);
}
END_TEST

static const float source[4] = { 0.2f, 0.4f, 0.6f, 0.8f }, destination[4] = { 1, 0.6f, 0.2f, 0.4f },
		   constant[4] = { 0.8f, 0.2f, 0.4f, 0.6f };

/* A channel's blend factor by table 4.2. */
static float factor_of(uint32_t factor, int c)
{
	switch (factor) {
	case GL_ZERO: return 0;
	case GL_ONE: return 1;
	case GL_SRC_COLOR: return source[c];
	case GL_ONE_MINUS_SRC_COLOR: return 1 - source[c];
	case GL_DST_COLOR: return destination[c];
	case GL_ONE_MINUS_DST_COLOR: return 1 - destination[c];
	case GL_SRC_ALPHA: return source[3];
	case GL_ONE_MINUS_SRC_ALPHA: return 1 - source[3];
	case GL_DST_ALPHA: return destination[3];
	case GL_ONE_MINUS_DST_ALPHA: return 1 - destination[3];
	case GL_CONSTANT_COLOR: return constant[c];
	case GL_ONE_MINUS_CONSTANT_COLOR: return 1 - constant[c];
	case GL_CONSTANT_ALPHA: return constant[3];
	case GL_ONE_MINUS_CONSTANT_ALPHA: return 1 - constant[3];
	default: return c == 3 ? 1 : fminf(source[3], 1 - destination[3]);
	}
}

/* Every factor and equation, in 8 bits, floats and halves. */
START_TEST(test_blending)
{
	static const uint32_t factors[] = {
		GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
		GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR,
		GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE
	};
	static const uint32_t equations[] = { GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX };
	enum { N = 15 };

	for (unsigned i = 0; i < 5 * N * N * 3; i++) {
		const uint32_t src = factors[i % N], dst = factors[i / N % N], equation = equations[i / N / N % 5],
			       floats = i / N / N / 5;
		struct scene_material m = {
			.blend = 1, .floats = floats, .blend_equation_rgb = equation,
			.blend_equation_alpha = equations[(i / N / N + 1) % 5], .blend_src_rgb = src, .blend_dst_rgb = dst,
			.blend_src_alpha = dst, .blend_dst_alpha = src
		};
		struct vec4 have;
		float got[4];

		memcpy(m.blend_color, constant, 16);
		have = pixel_source(&m, v4_load(source), v4_load(destination));
		memcpy(got, (float[4]){ have.x, have.y, have.z, have.w }, 16);
		for (int c = 0; c < 4; c++) {
			const float s = source[c] * factor_of(c == 3 ? dst : src, c), d = destination[c] * factor_of(c == 3 ? src : dst, c);
			const uint32_t of = c == 3 ? m.blend_equation_alpha : equation;
			float wanted = of == GL_FUNC_ADD ? s + d : of == GL_FUNC_SUBTRACT ? s - d : of == GL_FUNC_REVERSE_SUBTRACT ? d - s :
			               of == GL_MIN ? fminf(source[c], destination[c]) : fmaxf(source[c], destination[c]);

			wanted = floats ? wanted : fminf(fmaxf(wanted, 0), 1);
			ck_assert_msg(fabsf(got[c] - wanted) < (floats == SCENE_FLOATS ? 1e-6f :
			                                        floats                 ? 1.1e-3f :
			                                                                 1.01f / 255),
			              "%#x %#x %#x, floats %u, channel %d: %g, not %g", src, dst, of, floats, c, got[c],
			              wanted);
			if (floats == SCENE_HALVES)
				ck_assert_float_eq(got[c], pixel_half(got[c]));
		}
	}
}
END_TEST

/* Halves are truncated, including the largest and smallest. */
START_TEST(test_halves)
{
	static const float rows[][2] = { { 1, 1 },
		                         { 1.0009f, 1 },
		                         { 1.00098f, 1.0009765625f },
		                         { -3.1249f, -3.123046875f },
		                         { 65504, 65504 },
		                         { 65535, 65504 },
		                         { 1e9f, 65504 },
		                         { 5.9e-8f, 0 },
		                         { 6e-8f, 5.9604645e-8f },
		                         { 6.1e-5f, 6.097555e-5f },
		                         { 0, 0 } };

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		ck_assert_msg(fabsf(pixel_half(rows[i][0]) - rows[i][1]) <= 1e-7f * fabsf(rows[i][1]),
		              "%g is %.9g, not %.9g", rows[i][0], pixel_half(rows[i][0]), rows[i][1]);
	ck_assert(isinf(pixel_half(INFINITY)) && isnan(pixel_half(NAN)));
}
END_TEST

static struct shaded fragment_of(float alpha, float depth)
{
	return (struct shaded){ .gl = { 1, 1, 1, alpha }, .depth = depth, .flags = SHADED_THERE | SHADED_FRONT };
}

/* Alpha, stencil and depth test in sequence, and the values each leaves in the buffers. */
START_TEST(test_stencil_test)
{
	static const struct { uint32_t func, ref, mask, stored, depth_passes; int drawn; uint32_t left; } rows[] = {
		{ GL_EQUAL, 0x35, 0x0f, 0x05, 1, 1, 0x06 },  /* zpass: INCR */
		{ GL_EQUAL, 0x35, 0x1f, 0x05, 1, 0, 0x04 },  /* fail: DECR */
		{ GL_EQUAL, 0x05, 0x0f, 0xf5, 0, 0, 0x0a },  /* zfail: INVERT */
		{ GL_LESS, 0x07, 0x0e, 0x07, 1, 0, 0x06 },   /* 6 < 6 is false */
		{ GL_LESS, 0x05, 0x0e, 0x07, 1, 1, 0x08 },   /* 4 < 6 */
		{ GL_GREATER, 0xf1, 0x0f, 0x00, 1, 1, 0x01 },
		{ GL_ALWAYS, 0, 0, 0xff, 1, 1, 0xff }, { GL_NEVER, 0, 255, 0, 1, 0, 0 },
	};

	for (size_t i = 0; i < 2 * sizeof(rows) / sizeof(rows[0]); i++) {
		const size_t row = i / 2;
		struct scene_material m = { .stencil_test = 1, .depth_test = 1, .depth_func = GL_LESS, .depth_write = 1 };
		const struct scene_stencil used = { rows[row].func, rows[row].ref, rows[row].mask, 255,
			                            GL_DECR,        GL_INVERT,     GL_INCR },
					   other = { .func = GL_NEVER, .fail = GL_KEEP };
		struct shaded s = fragment_of(1, rows[row].depth_passes ? 0.25f : 0.75f);
		struct frame_pixel pixel = { .stencil = rows[row].stored, .depth = 0x800000 };

		m.stencil_front = i % 2 ? other : used;
		m.stencil_back = i % 2 ? used : other;
		s.flags &= i % 2 ? ~SHADED_FRONT : ~0u;
		ck_assert_msg(pixel_tests(&m, &s, &pixel, BUFFER_BITS) == rows[row].drawn, "row %zu", row);
		ck_assert_msg(pixel.stencil == rows[row].left, "row %zu: %#x, not %#x", row, pixel.stencil, rows[row].left);
		ck_assert_uint_eq(pixel.depth, rows[row].drawn ? 0x400000 : 0x800000);
	}
}
END_TEST

/* Without their buffers, stencil and depth test always pass. */
START_TEST(test_depth_test)
{
	struct scene_material m = { .stencil_test = 1,
		                    .depth_test = 1,
		                    .depth_func = GL_NEVER,
		                    .depth_write = 1,
		                    .stencil_front = { .func = GL_NEVER } };
	struct shaded s = fragment_of(1, 0.5f);
	struct frame_pixel pixel = { .depth = 7 };

	ck_assert_int_eq(pixel_tests(&m, &s, &pixel, 0), 1);
	ck_assert_uint_eq(pixel.depth, 7);
	ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BITS_OF(24u, 0u, 0u)), 0);
	m.depth_func = GL_ALWAYS;
	m.depth_write = 0;
	ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BITS_OF(16u, 0u, 0u)), 1);
	ck_assert_uint_eq(pixel.depth, 7);
	m.depth_write = 1;
	pixel.unknown = PIXEL_UNKNOWN_DEPTH;
	ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BITS_OF(16u, 0u, 0u)), 1);
	ck_assert_uint_eq(pixel.depth, 32768);
	ck_assert_uint_eq(pixel.unknown, 0);
}
END_TEST

/* Alpha tests in eight bits; alpha as coverage of four samples; disabled samples. */
START_TEST(test_alpha_and_samples)
{
	struct scene_material m = { .alpha_test = 1, .alpha_func = GL_GREATER, .alpha_ref = 0.5f };
	struct frame_pixel pixel = { .depth = 0 };
	struct shaded s;

	for (int code = 0; code < 256; code += 51) {
		s = fragment_of((float)code / 255, 0);
		m.alpha_ref = 102.2f / 255; /* 102 */
		ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BUFFER_BITS), code > 102);
	}
	m = (struct scene_material){ .alpha_to_coverage = 1 };
	for (uint32_t sample = 0; sample < 4; sample++)
		for (int quarter = 0; quarter <= 4; quarter++) {
			s = fragment_of(0.25f * (float)quarter, 0);
			m.alpha_to_coverage = 1;
			ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BUFFER_BITS | (sample + 1) << 24), quarter > (int)sample);
			m.alpha_to_coverage = 0;
			ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BUFFER_BITS | (sample + 1) << 24), 1);
			m.samples_off = 1u << sample;
			ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BUFFER_BITS | (sample + 1) << 24), 0);
			m.samples_off = 15u & ~m.samples_off;
			ck_assert_int_eq(pixel_tests(&m, &s, &pixel, BUFFER_BITS | (sample + 1) << 24), 1);
			m.samples_off = 0;
		}
}
END_TEST

/*
 * A pixel's records: draw, layers, surface; films without depth do not count if there is another surface. Colours that
 * replace all earlier ones, blended or not, are recognised.
 */
START_TEST(test_marks)
{
	static const struct {
		uint32_t blend, logic, depth_write, mask, there;
		int is_surface;
		uint32_t layers, unknown;
		float alpha;
	} rows[] = {
		{ 0, 0, 1, 15, 1, 1, 0, 0, 0.5f },
		{ 0, 0, 0, 15, 1, 1, 0, 0, 0.5f },
		{ 1, 0, 1, 15, 1, 1, 4, 1, 0.5f },
		{ 1, 0, 0, 15, 1, 0, 4, 1, 0.5f },
		{ 1, 0, 0, 15, 0, 1, 4, 1, 0.5f },
		{ 1, 0, 1, 15, 1, 1, 4, 0, 1 },
		{ 1, 0, 1, 15, 1, 1, 4, 1, 254.0f / 255 },
		{ 1, 0, 1, 11, 1, 1, 4, 1, 1 },
		{ 0, 0, 1, 3, 1, 1, 3, 1, 1 },
		{ 0, GL_XOR, 1, 15, 1, 1, 3, 1, 1 },
		{ 1, GL_XOR, 0, 15, 1, 0, 3, 1, 1 },
		{ 0, GL_COPY_INVERTED, 1, 15, 1, 1, 3, 0, 1 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct scene_material m = {
			.blend = rows[i].blend, .logic_op = rows[i].logic, .depth_write = rows[i].depth_write,
			.color_mask = rows[i].mask, .blend_src_rgb = GL_SRC_ALPHA, .blend_dst_rgb = GL_ONE_MINUS_SRC_ALPHA,
			.blend_equation_rgb = GL_FUNC_ADD
		};
		struct frame_pixel pixel = { .layers = 3,
			                     .unknown = PIXEL_UNKNOWN_COLOR,
			                     .surface = { .order = rows[i].there ? 5 : SCENE_NONE } };
		struct fragment f = { .order = 9 };
		struct shaded s = fragment_of(rows[i].alpha, 0);

		s.albedo[1] = 0.5f;
		pixel_mark(&m, &s, &f, 77, &pixel);
		ck_assert_uint_eq(pixel.id, 77);
		ck_assert_msg((pixel.surface.order == 9) == rows[i].is_surface, "row %zu", i);
		ck_assert_float_eq(pixel.albedo[1], rows[i].is_surface ? 0.5f : 0);
		ck_assert_uint_eq(pixel.layers, rows[i].layers);
		ck_assert_msg(pixel.unknown == rows[i].unknown, "row %zu", i);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("pixel formulas");

	tcase_add_test(tcase, test_comparisons);
	tcase_add_test(tcase, test_stencil_operations);
	tcase_add_test(tcase, test_logic_operations);
	tcase_add_test(tcase, test_blending);
	tcase_add_test(tcase, test_halves);
	tcase_add_test(tcase, test_stencil_test);
	tcase_add_test(tcase, test_depth_test);
	tcase_add_test(tcase, test_alpha_and_samples);
	tcase_add_test(tcase, test_marks);
	return run_case(tcase, "pixel formulas");
}
