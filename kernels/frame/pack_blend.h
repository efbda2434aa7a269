/*
 * Per-fragment operations on sixteen pixels of a row at once, a lane each: what pixel.h and blend.h do for one, to the
 * same bits. OpenCL C only. No stencil test, no logic operations, no samples, no frame buffers of floats.
 */
#pragma once

#include "kernels/frame/pack_combine.h"
#include "kernels/gl/pixel.h"

/* As pixel_depth_steps. */
WIDE_VECTORS static inline packu pack_depth_steps(packf depth, uint bits)
{
	depth = clamp01(depth);
	if (bits > 24)
		return select((packu)(0xffffffffu),
		              convert_uint16(select((packf)(0), depth, depth < 1.0f) * 2147483648.0f) << 1,
		              depth < 1.0f);
	return convert_uint16(pack_round(depth * (float)pixel_bits_mask(bits)));
}

/* As pixel_compare. */
WIDE_VECTORS static inline packi pack_compare(uint func, packu a, packu b)
{
	switch (func) {
	case GL_NEVER: return 0;
	case GL_LESS: return a < b;
	case GL_EQUAL: return a == b;
	case GL_LEQUAL: return a <= b;
	case GL_GREATER: return a > b;
	case GL_NOTEQUAL: return a != b;
	case GL_GEQUAL: return a >= b;
	default: return -1;
	}
}

/* As blend_round. */
WIDE_VECTORS static inline packu pack_code(packf x)
{
	return as_uint16(convert_int16(pack_round(clamp01(x) * 255.0f)));
}

/* As blend_factor. s, d: source and destination of a channel, with their alphas */
WIDE_VECTORS static inline packu pack_blend_factor(__global const struct scene_material *m, uint factor, int channel,
                                                   packu s, packu s_alpha, packu d, packu d_alpha)
{
	switch (factor) {
	case GL_ZERO: return 0;
	case GL_SRC_COLOR: return s;
	case GL_ONE_MINUS_SRC_COLOR: return 255 - s;
	case GL_DST_COLOR: return d;
	case GL_ONE_MINUS_DST_COLOR: return 255 - d;
	case GL_SRC_ALPHA: return s_alpha;
	case GL_ONE_MINUS_SRC_ALPHA: return 255 - s_alpha;
	case GL_DST_ALPHA: return d_alpha;
	case GL_ONE_MINUS_DST_ALPHA: return 255 - d_alpha;
	case GL_CONSTANT_COLOR: return blend_round(m->blend_color[channel]);
	case GL_ONE_MINUS_CONSTANT_COLOR: return 255 - blend_round(m->blend_color[channel]);
	case GL_CONSTANT_ALPHA: return blend_round(m->blend_color[3]);
	case GL_ONE_MINUS_CONSTANT_ALPHA: return 255 - blend_round(m->blend_color[3]);
	case GL_SRC_ALPHA_SATURATE: return channel == 3 ? (packu)(255) : min(s_alpha, 255 - d_alpha);
	default: return 255;
	}
}

/* As blend_multiply. */
WIDE_VECTORS static inline packu pack_blend_multiply(packu a, packu b)
{
	const packu ab = a * b;

	return (ab + (ab >> 8) + 128) >> 8;
}

/* As blend_equation. */
WIDE_VECTORS static inline packu pack_blend_equation(uint equation, packu s, packu fs, packu d, packu fd)
{
	const packu a = pack_blend_multiply(s, fs), b = pack_blend_multiply(d, fd);

	switch (equation) {
	case GL_FUNC_SUBTRACT: return max(a, b) - b;
	case GL_FUNC_REVERSE_SUBTRACT: return max(a, b) - a;
	case GL_MIN: return min(s, d);
	case GL_MAX: return max(s, d);
	default: return min(a + b, (packu)(255));
	}
}

/* One channel of blend_colors. */
WIDE_VECTORS static inline packf pack_blend(__global const struct scene_material *m, int channel, packf source,
                                            packu s_alpha, packf destination, packu d_alpha)
{
	const packu s = pack_code(source), d = pack_code(destination);
	const packu fs = pack_blend_factor(m, channel == 3 ? m->blend_src_alpha : m->blend_src_rgb, channel, s, s_alpha,
	                                   d, d_alpha);
	const packu fd = pack_blend_factor(m, channel == 3 ? m->blend_dst_alpha : m->blend_dst_rgb, channel, s, s_alpha,
	                                   d, d_alpha);

	return convert_float16(as_int16(pack_blend_equation(
		       channel == 3 ? m->blend_equation_alpha : m->blend_equation_rgb, s, fs, d, fd))) /
	       255.0f;
}

/* When nothing is left of a destination that is blended by a pair of factors: 0 never, 1 ever, 2 where the source's
 * alpha is 1. */
static inline int pack_blend_covers(uint source, uint destination)
{
	switch (source) {
	case GL_DST_COLOR:
	case GL_ONE_MINUS_DST_COLOR:
	case GL_DST_ALPHA:
	case GL_ONE_MINUS_DST_ALPHA:
	case GL_SRC_ALPHA_SATURATE: return 0;
	default: return destination == GL_ZERO ? 1 : destination == GL_ONE_MINUS_SRC_ALPHA ? 2 : 0;
	}
}

/* The same of all colours below fragments of a material. */
static inline int pack_covers(__global const struct scene_material *m)
{
	int rgb, alpha;

	if ((m->color_mask & 15) != 15 || m->surface.hidden & SCENE_LEFT_OUT)
		return 0;
	if (!m->blend)
		return 1;
	rgb = pack_blend_covers(m->blend_src_rgb, m->blend_dst_rgb);
	alpha = pack_blend_covers(m->blend_src_alpha, m->blend_dst_alpha);
	return m->blend_equation_rgb != GL_FUNC_ADD || m->blend_equation_alpha != GL_FUNC_ADD || !rgb || !alpha ?
	               0 :
	               max(rgb, alpha);
}
