/*
 * State of per-fragment operations and draw buffers (GL 2.1 sec. 4.1, 4.2.1; EXT_stencil_two_side): what each call
 * sets, and values that are errors and change nothing.
 */
#include <math.h>

#include "tests/gl/gl.h"

struct setting {
	const char *call, *letters;
	uint32_t args[4], error;
	size_t at; /* offset in struct gls_attribs of the state set */
	unsigned n;
	uint32_t wanted[4];
};

#define SETS(field, n, ...) 0, offsetof(struct gls_attribs, field), n, { __VA_ARGS__ }
#define FRONT(field) stencil.side[0].field
#define BACK(field) stencil.side[1].field

static const struct setting settings[] = {
	{ "glDepthFunc", "e", { GL_GEQUAL }, SETS(depth.func, 1, GL_GEQUAL) },
	{ "glDepthFunc", "e", { GL_KEEP }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glDepthMask", "i", { 0 }, SETS(depth.write, 1, 0) },
	{ "glDepthMask", "i", { 5 }, SETS(depth.write, 1, 1) },
	{ "glScissor", "iiii", { 1, 2, 3, 4 }, SETS(scissor.rect, 4, 1, 2, 3, 4) },
	{ "glScissor", "iiii", { 5, 6, -1, 8 }, GL_INVALID_VALUE, 0, 0, { 0 } },
	{ "glScissor", "iiii", { 5, 6, 7, -1 }, GL_INVALID_VALUE, 0, 0, { 0 } },
	{ "glColorMask", "iiii", { 1, 0, 0, 1 }, SETS(color.mask, 1, 9) },
	{ "glColorMask", "iiii", { 0, 2, 3, 0 }, SETS(color.mask, 1, 6) },
	{ "glLogicOp", "e", { GL_XOR }, SETS(color.logic_op, 1, GL_XOR) },
	{ "glLogicOp", "e", { GL_CLEAR }, SETS(color.logic_op, 1, GL_CLEAR) },
	{ "glLogicOp", "e", { GL_SET }, SETS(color.logic_op, 1, GL_SET) },
	{ "glLogicOp", "e", { GL_SET + 1 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glBlendFunc",
	  "ee",
	  { GL_SRC_ALPHA_SATURATE, GL_ONE_MINUS_CONSTANT_ALPHA },
	  SETS(color.src_rgb, 1, GL_SRC_ALPHA_SATURATE) },
	{ "glBlendFunc", "ee", { GL_DST_COLOR, GL_CONSTANT_COLOR }, SETS(color.dst_alpha, 1, GL_CONSTANT_COLOR) },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ONE, GL_ZERO, GL_SRC_COLOR, GL_DST_ALPHA },
	  SETS(color.src_rgb, 1, GL_ONE) },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ONE, GL_ZERO, GL_SRC_COLOR, GL_DST_ALPHA },
	  SETS(color.dst_rgb, 1, GL_ZERO) },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ONE, GL_ZERO, GL_SRC_COLOR, GL_DST_ALPHA },
	  SETS(color.src_alpha, 1, GL_SRC_COLOR) },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ONE, GL_ZERO, GL_SRC_COLOR, GL_DST_ALPHA },
	  SETS(color.dst_alpha, 1, GL_DST_ALPHA) },
	{ "glBlendFuncSeparate", "eeee", { 2, GL_ZERO, GL_ZERO, GL_ZERO }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ZERO, GL_SRC_COLOR - 1, GL_ZERO, GL_ZERO },
	  GL_INVALID_ENUM,
	  0,
	  0,
	  { 0 } },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ZERO, GL_ZERO, GL_SRC_ALPHA_SATURATE + 1, GL_ZERO },
	  GL_INVALID_ENUM,
	  0,
	  0,
	  { 0 } },
	{ "glBlendFuncSeparate",
	  "eeee",
	  { GL_ZERO, GL_ZERO, GL_ZERO, GL_CONSTANT_COLOR - 1 },
	  GL_INVALID_ENUM,
	  0,
	  0,
	  { 0 } },
	{ "glBlendEquation", "e", { GL_MAX }, SETS(color.equation_alpha, 1, GL_MAX) },
	{ "glBlendEquationSeparate",
	  "ee",
	  { GL_FUNC_REVERSE_SUBTRACT, GL_MIN },
	  SETS(color.equation_rgb, 1, GL_FUNC_REVERSE_SUBTRACT) },
	{ "glBlendEquationSeparate", "ee", { GL_FUNC_SUBTRACT, GL_MIN }, SETS(color.equation_alpha, 1, GL_MIN) },
	{ "glBlendEquationSeparate", "ee", { GL_FUNC_ADD, GL_ADD }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glBlendEquation", "e", { GL_LOGIC_OP }, GL_INVALID_ENUM, 0, 0, { 0 } },
	/* the reference is clamped to eight bits; masks are stored unchanged */
	{ "glStencilFunc", "eiu", { GL_LESS, 300, 0x1ff }, SETS(BACK(func), 3, GL_LESS, 255, 0x1ff) },
	{ "glStencilFunc", "eiu", { GL_NOTEQUAL, -3, 7 }, SETS(FRONT(func), 3, GL_NOTEQUAL, 0, 7) },
	{ "glStencilFunc", "eiu", { GL_ALWAYS + 1, 0, 7 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glStencilFuncSeparate", "eeiu", { GL_BACK, GL_EQUAL, 8, 9 }, SETS(BACK(func), 3, GL_EQUAL, 8, 9) },
	{ "glStencilFuncSeparate", "eeiu", { GL_BACK, GL_LEQUAL, 4, 5 }, SETS(FRONT(func), 3, GL_NOTEQUAL, 0, 7) },
	{ "glStencilFuncSeparate", "eeiu", { GL_FRONT, GL_GREATER, 10, 11 }, SETS(FRONT(func), 3, GL_GREATER, 10, 11) },
	{ "glStencilFuncSeparate", "eeiu", { GL_LEFT, GL_EQUAL, 8, 9 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glStencilOp",
	  "eee",
	  { GL_INCR, GL_DECR_WRAP, GL_INVERT },
	  SETS(BACK(fail), 3, GL_INCR, GL_DECR_WRAP, GL_INVERT) },
	{ "glStencilOpSeparate",
	  "eeee",
	  { GL_FRONT, GL_ZERO, GL_REPLACE, GL_KEEP },
	  SETS(FRONT(fail), 3, GL_ZERO, GL_REPLACE, GL_KEEP) },
	{ "glStencilOpSeparate",
	  "eeee",
	  { GL_FRONT, GL_DECR, GL_INCR_WRAP, GL_KEEP },
	  SETS(BACK(fail), 3, GL_INCR, GL_DECR_WRAP, GL_INVERT) },
	{ "glStencilOp", "eee", { GL_ONE, GL_KEEP, GL_KEEP }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glStencilOp", "eee", { GL_KEEP, GL_NEVER, GL_KEEP }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glStencilOp", "eee", { GL_KEEP, GL_KEEP, GL_SET }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glStencilMask", "u", { 0x55 }, SETS(BACK(write_mask), 1, 0x55) },
	{ "glStencilMaskSeparate", "eu", { GL_FRONT, 0xaa }, SETS(FRONT(write_mask), 1, 0xaa) },
	{ "glStencilMaskSeparate", "eu", { GL_FRONT, 0x77 }, SETS(BACK(write_mask), 1, 0x55) },
	{ "glClearStencil", "i", { 9 }, SETS(stencil.clear, 1, 9) },
	/* with two-sided stencil, a call without a face sets the active one */
	{ "glActiveStencilFaceEXT", "e", { GL_BACK }, SETS(stencil.active_face, 1, GL_BACK) },
	{ "glEnable", "e", { GL_STENCIL_TEST_TWO_SIDE_EXT }, SETS(stencil.two_side, 1, 1) },
	{ "glStencilFunc", "eiu", { GL_NEVER, 1, 2 }, SETS(BACK(func), 3, GL_NEVER, 1, 2) },
	{ "glStencilFunc", "eiu", { GL_NEVER, 3, 4 }, SETS(FRONT(func), 3, GL_GREATER, 10, 11) },
	{ "glStencilMask", "u", { 0x11 }, SETS(FRONT(write_mask), 1, 0x77) },
	/* sec. 4.2.1: there are no right and no auxiliary buffers; attachments are for framebuffer objects */
	{ "glDrawBuffer", "e", { GL_FRONT_LEFT }, SETS(color.draw_buffer, 1, GL_FRONT_LEFT) },
	{ "glDrawBuffer", "e", { GL_FRONT_AND_BACK }, SETS(color.draw_buffer, 1, GL_FRONT_AND_BACK) },
	{ "glDrawBuffer", "e", { GL_NONE }, SETS(color.draw_buffer, 1, GL_NONE) },
	{ "glDrawBuffer", "e", { GL_COLOR_ATTACHMENT0 }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_COLOR_ATTACHMENT0 + 31 }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_COLOR_ATTACHMENT0 + 32 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_COLOR_ATTACHMENT0 - 1 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_FRONT_RIGHT }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_BACK_RIGHT }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_RIGHT }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_AUX0 }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_AUX0 + 3 }, GL_INVALID_OPERATION, 0, 0, { 0 } },
	{ "glDrawBuffer", "e", { GL_AUX0 + 4 }, GL_INVALID_ENUM, 0, 0, { 0 } },
	{ "glReadBuffer", "e", { GL_FRONT }, SETS(pixel.read_buffer, 1, GL_FRONT) },
};

START_TEST(test_settings)
{
	struct gl gl = gl_open();
	const struct gls_attribs *a = &gl_state(&gl)->a;
	struct gls_attribs before;

	for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); i++) {
		const struct setting *s = &settings[i];
		uint32_t error;

		before = *a;
		gl_call(&gl, s->call, s->letters, s->args[0], s->args[1], s->args[2], s->args[3]);
		error = gl_error(&gl);
		ck_assert_msg(error == s->error, "row %zu, %s: error %#x, not %#x", i, s->call, error, s->error);
		if (error)
			ck_assert_msg(!memcmp(&before, a, sizeof(before)), "row %zu, %s: an error changed state", i,
			              s->call);
		ck_assert_msg(!memcmp((const char *)a + s->at, s->wanted, s->n * sizeof(uint32_t)),
		              "row %zu, %s: wrong state was set", i, s->call);
	}
	gl_close(&gl);
}
END_TEST

/* Clear colours are not clamped, the clear depth is clamped to [0,1]. */
START_TEST(test_numbers)
{
	struct gl gl = gl_open();
	const struct gls_attribs *a = &gl_state(&gl)->a;

	gl_call(&gl, "glAlphaFunc", "ef", GL_NEVER, 1.5);
	ck_assert_uint_eq(a->color.alpha_func, GL_NEVER);
	gl_call(&gl, "glAlphaFunc", "ef", GL_ALWAYS + 1, 0.25);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glAlphaFunc", "ef", GL_NEVER - 1, 0.25);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	ck_assert_float_eq(a->color.alpha_ref, 1.5f);
	gl_call(&gl, "glBlendColor", "ffff", 0.1, 0.2, 0.3, 1.5);
	gl_call(&gl, "glClearColor", "ffff", 0.4, 0.5, 0.6, -0.5);
	gl_call(&gl, "glClearAccum", "ffff", -1.0, 0.25, 0.5, 0.75);
	gl_call(&gl, "glClearDepth", "d", 1.5);
	ck_assert_floats(4, a->color.blend_color, 0.1f, 0.2f, 0.3f, 1.5f);
	ck_assert_floats(4, a->color.clear, 0.4f, 0.5f, 0.6f, -0.5f);
	ck_assert_floats(4, a->accum.clear, -1, 0.25f, 0.5f, 0.75f);
	ck_assert_double_eq(a->depth.clear, 1);
	gl_call(&gl, "glClearDepth", "d", 0.25);
	ck_assert_double_eq(a->depth.clear, 0.25);
	gl_close(&gl);
}
END_TEST

GL_TESTS("fragment", test_settings, test_numbers)
