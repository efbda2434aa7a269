/* Per-fragment operations and the whole framebuffer (GL 2.1 sec. 4.1, 4.2). */

#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

GLS_HANDLER(glScissor, STATE)
{
	if (gls_refuses(x, st, arg_i(c, 2) < 0 || arg_i(c, 3) < 0, GL_INVALID_VALUE))
		return;
	for (unsigned i = 0; i < 4; i++)
		st->a.scissor.rect[i] = (int32_t)arg_i(c, i);
}

GLS_HANDLER(glAlphaFunc, STATE)
{
	if (gls_refuses(x, st, !gls_is_compare_func(arg_u(c, 0)), GL_INVALID_ENUM))
		return;
	st->a.color.alpha_func = arg_u(c, 0);
	st->a.color.alpha_ref = arg_f(c, 1);
}

/* ---- stencil, sec. 4.1.5 ---- */

static int is_stencil_op(uint32_t op)
{
	return op == GL_KEEP || op == GL_ZERO || op == GL_REPLACE || op == GL_INCR || op == GL_DECR || op == GL_INVERT ||
	       op == GL_INCR_WRAP || op == GL_DECR_WRAP;
}

/* 1 if a call without a face argument changes this side: both, or the active one if EXT_stencil_two_side is enabled. */
static int changes_side(const struct gls_state *st, unsigned side, uint32_t face)
{
	if (face == GL_FRONT_AND_BACK)
		return !st->a.stencil.two_side || st->a.stencil.active_face == (side ? GL_BACK : GL_FRONT);
	return face == (side ? GL_BACK : GL_FRONT);
}

static void stencil_func(struct gls_exec *x, struct gls_state *st, uint32_t face, uint32_t func, uint32_t ref,
                         uint32_t mask)
{
	if (gls_refuses(x, st, !gls_is_compare_func(func) || !gls_is_face(face), GL_INVALID_ENUM))
		return;
	for (unsigned side = 0; side < 2; side++) {
		if (!changes_side(st, side, face))
			continue;
		st->a.stencil.side[side].func = func;
		st->a.stencil.side[side].ref = (int32_t)ref < 0 ? 0 : ref > 255 ? 255 : ref;
		st->a.stencil.side[side].compare_mask = mask;
	}
}

static void stencil_op(struct gls_exec *x, struct gls_state *st, uint32_t face, uint32_t fail, uint32_t zfail,
                       uint32_t zpass)
{
	if (gls_refuses(x, st,
	                !is_stencil_op(fail) || !is_stencil_op(zfail) || !is_stencil_op(zpass) || !gls_is_face(face),
	                GL_INVALID_ENUM))
		return;
	for (unsigned side = 0; side < 2; side++) {
		if (!changes_side(st, side, face))
			continue;
		st->a.stencil.side[side].fail = fail;
		st->a.stencil.side[side].zfail = zfail;
		st->a.stencil.side[side].zpass = zpass;
	}
}

static void stencil_mask(struct gls_exec *x, struct gls_state *st, uint32_t face, uint32_t mask)
{
	if (gls_refuses(x, st, !gls_is_face(face), GL_INVALID_ENUM))
		return;
	for (unsigned side = 0; side < 2; side++)
		if (changes_side(st, side, face))
			st->a.stencil.side[side].write_mask = mask;
}

GLS_HANDLER(glStencilFunc, STATE) { stencil_func(x, st, GL_FRONT_AND_BACK, arg_u(c, 0), arg_u(c, 1), arg_u(c, 2)); }
GLS_HANDLER(glStencilFuncSeparate, STATE) { stencil_func(x, st, arg_u(c, 0), arg_u(c, 1), arg_u(c, 2), arg_u(c, 3)); }
GLS_HANDLER(glStencilOp, STATE) { stencil_op(x, st, GL_FRONT_AND_BACK, arg_u(c, 0), arg_u(c, 1), arg_u(c, 2)); }
GLS_HANDLER(glStencilOpSeparate, STATE) { stencil_op(x, st, arg_u(c, 0), arg_u(c, 1), arg_u(c, 2), arg_u(c, 3)); }
GLS_HANDLER(glStencilMask, STATE) { stencil_mask(x, st, GL_FRONT_AND_BACK, arg_u(c, 0)); }
GLS_HANDLER(glStencilMaskSeparate, STATE) { stencil_mask(x, st, arg_u(c, 0), arg_u(c, 1)); }
GLS_HANDLER(glActiveStencilFaceEXT, STATE) { st->a.stencil.active_face = arg_u(c, 0); }

/* ---- depth, sec. 4.1.6 ---- */

GLS_HANDLER(glDepthFunc, STATE)
{
	if (!gls_refuses(x, st, !gls_is_compare_func(arg_u(c, 0)), GL_INVALID_ENUM))
		st->a.depth.func = arg_u(c, 0);
}

GLS_HANDLER(glDepthMask, STATE) { st->a.depth.write = arg_i(c, 0) != 0; }

/* ---- blending and logic op, sec. 4.1.8, 4.1.10 ---- */

static int is_blend_equation(uint32_t mode)
{
	return mode == GL_FUNC_ADD || mode == GL_FUNC_SUBTRACT || mode == GL_FUNC_REVERSE_SUBTRACT || mode == GL_MIN ||
	       mode == GL_MAX;
}

static int is_blend_factor(uint32_t f)
{
	return f == GL_ZERO || f == GL_ONE || (f >= GL_SRC_COLOR && f <= GL_SRC_ALPHA_SATURATE) ||
	       (f >= GL_CONSTANT_COLOR && f <= GL_ONE_MINUS_CONSTANT_ALPHA);
}

static void blend_func(struct gls_exec *x, struct gls_state *st, uint32_t src_rgb, uint32_t dst_rgb, uint32_t src_alpha,
                       uint32_t dst_alpha)
{
	struct gls_color_buffer *b = &st->a.color;

	if (!is_blend_factor(src_rgb) || !is_blend_factor(dst_rgb) || !is_blend_factor(src_alpha) ||
	    !is_blend_factor(dst_alpha)) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	b->src_rgb = src_rgb;
	b->dst_rgb = dst_rgb;
	b->src_alpha = src_alpha;
	b->dst_alpha = dst_alpha;
}

static void blend_equation(struct gls_exec *x, struct gls_state *st, uint32_t rgb, uint32_t alpha)
{
	if (gls_refuses(x, st, !is_blend_equation(rgb) || !is_blend_equation(alpha), GL_INVALID_ENUM))
		return;
	st->a.color.equation_rgb = rgb;
	st->a.color.equation_alpha = alpha;
}

GLS_HANDLER(glBlendFunc, STATE) { blend_func(x, st, arg_u(c, 0), arg_u(c, 1), arg_u(c, 0), arg_u(c, 1)); }
GLS_HANDLER(glBlendFuncSeparate, STATE) { blend_func(x, st, arg_u(c, 0), arg_u(c, 1), arg_u(c, 2), arg_u(c, 3)); }
GLS_HANDLER(glBlendEquation, STATE) { blend_equation(x, st, arg_u(c, 0), arg_u(c, 0)); }
GLS_HANDLER(glBlendEquationSeparate, STATE) { blend_equation(x, st, arg_u(c, 0), arg_u(c, 1)); }

static void read_color(const struct call *c, float out[4])
{
	for (unsigned i = 0; i < 4; i++)
		out[i] = arg_f(c, i);
}

GLS_HANDLER(glBlendColor, STATE) { read_color(c, st->a.color.blend_color); }

/* ARB_color_buffer_float. CLAMP_READ_COLOR only affects what the program reads back, so we ignore it. */
GLS_HANDLER(glClampColor, STATE)
{
	uint32_t clamp = arg_u(c, 1);

	if (clamp > GL_TRUE && clamp != GL_FIXED_ONLY)
		gls_error(x, st, GL_INVALID_ENUM);
	else if (arg_u(c, 0) == GL_CLAMP_VERTEX_COLOR)
		st->a.lighting.clamp = clamp;
	else if (arg_u(c, 0) == GL_CLAMP_FRAGMENT_COLOR)
		st->a.color.clamp = clamp;
	else if (arg_u(c, 0) != GL_CLAMP_READ_COLOR)
		gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glLogicOp, STATE)
{
	if (!gls_refuses(x, st, arg_u(c, 0) < GL_CLEAR || arg_u(c, 0) > GL_SET, GL_INVALID_ENUM))
		st->a.color.logic_op = arg_u(c, 0);
}

GLS_HANDLER(glColorMask, STATE)
{
	st->a.color.mask = 0;
	for (unsigned i = 0; i < 4; i++)
		st->a.color.mask |= (uint32_t)(arg_i(c, i) != 0) << i;
}

/* ---- buffer selection and clear values (sec. 4.2) ---- */

/*
 * Buffers of windows are not valid for framebuffer objects, nor the reverse. Windows have neither right nor auxiliary
 * buffers here, as on nearly every machine.
 */
static int refuses_buffer(struct gls_exec *x, struct gls_state *st, uint32_t buffer, uint32_t framebuffer)
{
	const int is_attachment = buffer >= GL_COLOR_ATTACHMENT0 && buffer < GL_COLOR_ATTACHMENT0 + 32;
	const int is_window = buffer >= GL_FRONT_LEFT && buffer <= GL_AUX3;
	const int is_absent = buffer == GL_FRONT_RIGHT || buffer == GL_BACK_RIGHT || buffer == GL_RIGHT ||
	                      (buffer >= GL_AUX0 && buffer <= GL_AUX3);

	return gls_refuses(x, st, !is_attachment && !is_window && buffer != GL_NONE, GL_INVALID_ENUM) ||
	       gls_refuses(x, st, framebuffer ? is_window : is_attachment || is_absent, GL_INVALID_OPERATION);
}

GLS_HANDLER(glDrawBuffer, STATE)
{
	if (refuses_buffer(x, st, arg_u(c, 0), st->draw_framebuffer))
		return;
	st->a.color.also_drawn = 0;
	st->a.color.draw_buffer = arg_u(c, 0);
}

GLS_HANDLER(glReadBuffer, STATE)
{
	const uint32_t buffer = arg_u(c, 0);

	if (!gls_refuses(x, st, buffer == GL_FRONT_AND_BACK, GL_INVALID_ENUM) &&
	    !refuses_buffer(x, st, buffer, st->read_framebuffer))
		st->a.pixel.read_buffer = buffer;
}

GLS_HANDLER(glClearColor, STATE) { read_color(c, st->a.color.clear); }
GLS_HANDLER(glClearDepth, STATE) { st->a.depth.clear = arg_clamped(c, 0); }
GLS_HANDLER(glClearStencil, STATE) { st->a.stencil.clear = arg_u(c, 0); }
GLS_HANDLER(glClearIndex, STATE) {} /* colour index mode only */
GLS_HANDLER(glClearAccum, STATE) { read_color(c, st->a.accum.clear); }
