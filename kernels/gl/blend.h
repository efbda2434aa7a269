/*
 * Blending (GL 2.1 sec. 4.1.8) in frame buffers of 8 bits per channel, of floats, and of sRGB.
 *
 * With 8 bits, it computes in 8-bit integers: the source is rounded before blending, not after. The specification
 * leaves the arithmetic open. This is llvmpipe's (Mesa 22.3.6): trails and clouds of particles blend many times, and
 * must not drift away from the program's own picture.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"

#include "kernels/gl/blend_lanes.h"

/* Blend a source colour over a destination, by a material's factors and equations: 8 bits per channel. */
static inline struct vec4 blend_colors(GLOBAL const struct scene_material *m, struct vec4 source,
                                       struct vec4 destination)
{
	const uint32_t s_alpha = blend_round(source.w), d_alpha = blend_round(destination.w);

	return v4(blend_channel(m, 0, source.x, s_alpha, destination.x, d_alpha),
	          blend_channel(m, 1, source.y, s_alpha, destination.y, d_alpha),
	          blend_channel(m, 2, source.z, s_alpha, destination.z, d_alpha),
	          blend_channel(m, 3, source.w, s_alpha, destination.w, d_alpha));
}

/* --- Frame buffers of floats: the same, without rounding --------------------------------------------------------- */

/* A factor's value for all channels (table 4.2). s, d: source and destination; c: the blend colour */
static inline struct vec4 blend_float_factor(uint32_t factor, struct vec4 s, struct vec4 d, struct vec4 c)
{
	struct vec4 one = v4(1.0f, 1.0f, 1.0f, 1.0f);
	float f;

	switch (factor) {
	case GL_ZERO: return v4(0.0f, 0.0f, 0.0f, 0.0f);
	case GL_SRC_COLOR: return s;
	case GL_ONE_MINUS_SRC_COLOR: return v4_sub(one, s);
	case GL_DST_COLOR: return d;
	case GL_ONE_MINUS_DST_COLOR: return v4_sub(one, d);
	case GL_SRC_ALPHA: return v4(s.w, s.w, s.w, s.w);
	case GL_ONE_MINUS_SRC_ALPHA: return v4_sub(one, v4(s.w, s.w, s.w, s.w));
	case GL_DST_ALPHA: return v4(d.w, d.w, d.w, d.w);
	case GL_ONE_MINUS_DST_ALPHA: return v4_sub(one, v4(d.w, d.w, d.w, d.w));
	case GL_CONSTANT_COLOR: return c;
	case GL_ONE_MINUS_CONSTANT_COLOR: return v4_sub(one, c);
	case GL_CONSTANT_ALPHA: return v4(c.w, c.w, c.w, c.w);
	case GL_ONE_MINUS_CONSTANT_ALPHA: return v4_sub(one, v4(c.w, c.w, c.w, c.w));
	case GL_SRC_ALPHA_SATURATE:
		f = M_MIN(s.w, 1.0f - d.w);
		return v4(f, f, f, 1.0f);
	default: return one;
	}
}

/* One channel by a blend equation (table 4.1). fs, fd: the factors of s and d, which GL_MIN and GL_MAX ignore */
static inline float blend_float_equation(uint32_t equation, float s, float fs, float d, float fd)
{
	switch (equation) {
	case GL_FUNC_SUBTRACT: return s * fs - d * fd;
	case GL_FUNC_REVERSE_SUBTRACT: return d * fd - s * fs;
	case GL_MIN: return M_MIN(s, d);
	case GL_MAX: return M_MAX(s, d);
	default: return s * fs + d * fd;
	}
}

/* Blend a source colour over a destination, as blend_colors does. Nothing is clamped. */
static inline struct vec4 blend_floats(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d)
{
	struct vec4 c = v4_load(m->blend_color);
	struct vec4 fs = blend_float_factor(m->blend_src_rgb, s, d, c), fd = blend_float_factor(m->blend_dst_rgb, s, d, c);
	struct vec4 fs_alpha = blend_float_factor(m->blend_src_alpha, s, d, c);
	struct vec4 fd_alpha = blend_float_factor(m->blend_dst_alpha, s, d, c);

	return v4(blend_float_equation(m->blend_equation_rgb, s.x, fs.x, d.x, fd.x),
	          blend_float_equation(m->blend_equation_rgb, s.y, fs.y, d.y, fd.y),
	          blend_float_equation(m->blend_equation_rgb, s.z, fs.z, d.z, fd.z),
	          blend_float_equation(m->blend_equation_alpha, s.w, fs_alpha.w, d.w, fd_alpha.w));
}

/* --- sRGB frame buffers: llvmpipe's approximations (22.3.6, lp_bld_format_srgb.c), exact to half a code ---------- */

/* Linear light, [0,1], of a code, 0 to 255: a line, then a cubic, whose even and odd powers are summed apart. */
static inline float blend_linear_from_code(uint32_t code)
{
	const float x = (float)code, x2 = x * x;
	const float even = M_FMA(x2, 0.6935f / (255.0f * 255.0f), 0.0023f);
	const float odd = M_FMA(x2, 0.3012f / (255.0f * 255.0f * 255.0f), 0.0030f / 255.0f);

	return code <= 15u ? x * (1.0f / (12.6f * 255.0f)) : M_FMA(odd, x, even);
}

/* The inverse, for linear light clamped to [0,1]: code / 255, not rounded. Above the line, x^(1/2.4) is a mixture of
 * x^0.375 (`power`) and x^0.5 (`root`). */
static inline float blend_code_from_linear(float linear)
{
	const float x = clamp01(linear), root = M_SQRT(x), power = M_SQRT(M_SQRT(root * x));

	return x <= 0.0031308f ? 12.92f * x : 0.675f * 1.0622f * power + (0.325f * 1.0622f * root - 0.0620f);
}
