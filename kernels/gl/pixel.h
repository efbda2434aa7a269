/*
 * Per-fragment operations (GL 2.1 sec. 4.1) and clears (sec. 4.2.3) on one pixel. They process GL's own colours and
 * each step from there to the beauty (struct shaded) side by side; GL's colours decide all tests.
 *
 * Operations that read a colour back (blending, logic op) first round it to 8 bits, as the frame buffer does. Other
 * colours are not changed.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"
#include "kernels/gl/blend.h"

/* Map a float to an integer, so that integers compare as the floats do. */
static inline uint32_t pixel_order(float x)
{
	uint32_t bits = M_BITS(x + 0.0f); /* so that there is a single zero */

	return bits >> 31 ? ~bits : bits | 0x80000000u;
}

/* The largest number that fits into `bits` bits. */
static inline uint32_t pixel_bits_mask(uint32_t bits)
{
	return bits >= 32u ? 0xffffffffu : (1u << bits) - 1u;
}

#include "kernels/gl/pixel_lanes.h"

/* --- Stencil (sec. 4.1.5) ---------------------------------------------------------------------------------------- */

/* A stencil value after an operation. bits: of the stencil buffer */
static inline uint32_t pixel_stencil_apply(uint32_t op, uint32_t value, uint32_t ref, uint32_t write_mask,
                                           uint32_t bits)
{
	uint32_t top = pixel_bits_mask(bits), out = value;

	switch (op) {
	case GL_ZERO: out = 0u; break;
	case GL_REPLACE: out = ref & top; break;
	case GL_INCR: out = value < top ? value + 1u : top; break;
	case GL_DECR: out = value ? value - 1u : 0u; break;
	case GL_INCR_WRAP: out = (value + 1u) & top; break;
	case GL_DECR_WRAP: out = (value - 1u) & top; break;
	case GL_INVERT: out = ~value & top; break;
	default: break;
	}
	return (value & ~write_mask) | (out & write_mask);
}

/* --- Logic operation (sec. 4.1.10) ------------------------------------------------------------------------------- */

/* One channel, in [0,1], by a logic operation on its 8-bit codes. */
static inline float pixel_logic(uint32_t op, float source, float destination)
{
	uint32_t s = (uint32_t)M_RINT(source * 255.0f), d = (uint32_t)M_RINT(destination * 255.0f), out = s;

	switch (op) {
	case GL_CLEAR: out = 0u; break;
	case GL_AND: out = s & d; break;
	case GL_AND_REVERSE: out = s & ~d; break;
	case GL_AND_INVERTED: out = ~s & d; break;
	case GL_NOOP: out = d; break;
	case GL_XOR: out = s ^ d; break;
	case GL_OR: out = s | d; break;
	case GL_NOR: out = ~(s | d); break;
	case GL_EQUIV: out = ~(s ^ d); break;
	case GL_INVERT: out = ~d; break;
	case GL_OR_REVERSE: out = s | ~d; break;
	case GL_COPY_INVERTED: out = ~s; break;
	case GL_OR_INVERTED: out = ~s | d; break;
	case GL_NAND: out = ~(s & d); break;
	case GL_SET: out = 255u; break;
	default: break; /* COPY */
	}
	return (float)(out & 255u) / 255.0f;
}

/* --- Storing one colour ------------------------------------------------------------------------------------------ */

/* A channel as a frame buffer of 8 bits stores it. */
static inline float pixel_stored(float x)
{
	return M_RINT(clamp01(x) * 255.0f) / 255.0f;
}

/* A number as llvmpipe (22.3.6) stores it in a half: excess bits are truncated, not rounded. */
static inline float pixel_half(float x)
{
	const uint32_t bits = M_BITS(x), size = bits & 0x7fffffffu;
	uint32_t cut = size & ~0x1fffu;

	if (size >= 0x7f800000u) /* NaN and infinity */
		return x;
	if (size >= 0x477fe000u)
		cut = 0x477fe000u; /* the largest */
	else if (size < 0x38800000u) /* subnormal: in steps of 2^-24 */
		cut = M_BITS((float)(uint32_t)(M_FLOAT(size) * 16777216.0f) / 16777216.0f);
	return M_FLOAT((bits & 0x80000000u) | cut);
}

/* An sRGB drawable: blended in linear light, with llvmpipe's encoding in both directions. */
static inline struct vec4 pixel_encoded(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d, int blends)
{
	s = v4(clamp01(s.x), clamp01(s.y), clamp01(s.z), clamp01(s.w));
	if (blends)
		s = blend_floats(m, s, v4(blend_linear_from_code(blend_round(d.x)), blend_linear_from_code(blend_round(d.y)),
		                          blend_linear_from_code(blend_round(d.z)), pixel_stored(d.w)));
	return v4(blend_code_from_linear(s.x), blend_code_from_linear(s.y), blend_code_from_linear(s.z), s.w);
}

/* A source colour after blending or the logic operation over a destination; before it is stored. */
static inline struct vec4 pixel_blended(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d)
{
	if (m->srgb && !m->floats && !m->logic_op)
		return pixel_encoded(m, s, d, m->blend != 0u);
	if (!m->blend && !m->logic_op)
		return s;
	if (m->floats)
		return blend_floats(m, s, d);
	d = v4(pixel_stored(d.x), pixel_stored(d.y), pixel_stored(d.z), pixel_stored(d.w));
	if (m->logic_op) /* replaces blending (sec. 4.1.10) */
		return v4(pixel_logic(m->logic_op, s.x, d.x), pixel_logic(m->logic_op, s.y, d.y),
		          pixel_logic(m->logic_op, s.z, d.z), pixel_logic(m->logic_op, s.w, d.w));
	return blend_colors(m, s, d);
}

/* The colour that the frame buffer receives for a source over a destination; the caller applies the mask. */
static inline struct vec4 pixel_source(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d)
{
	s = pixel_blended(m, s, d);
	return m->floats == SCENE_HALVES ? v4(pixel_half(s.x), pixel_half(s.y), pixel_half(s.z), pixel_half(s.w)) : s;
}

/*
 * Properties of the frame buffer, as passed to kernels: depth bits | stencil bits << 8 | alpha bits << 16. With several
 * samples per pixel, the number of the drawn sample, starting at 1, << 24. With PIXEL_FOLLOWS, a sample makes no tests
 * of its own: its colours are written if the first sample passed its tests. llvmpipe (22.3.6) does this when drawing
 * without multisampling to a frame buffer with samples.
 */
#define PIXEL_FOLLOWS 0x80000000u

static inline int pixel_is_sampled(uint32_t bits)
{
	return (bits >> 24 & 127u) != 0u;
}

/* Index of the drawn sample, starting at 0. */
static inline uint32_t pixel_sample(uint32_t bits)
{
	return pixel_is_sampled(bits) ? (bits >> 24 & 127u) - 1u : 0u;
}

static inline uint32_t pixel_depth_bits(uint32_t bits)
{
	return bits & 255u;
}

static inline uint32_t pixel_stencil_bits(uint32_t bits)
{
	return bits >> 8 & 255u;
}

static inline uint32_t pixel_alpha_bits(uint32_t bits)
{
	return bits >> 16 & 255u;
}

/* A pixel as GL's frame buffer held it; the other fields are 0. depth: in the buffer's steps; 24 bits count */
static inline void pixel_start(struct frame_pixel *pixel, const float gl[4], uint32_t depth, uint32_t bits)
{
	const uint32_t depth_bits = pixel_depth_bits(bits), far = pixel_bits_mask(depth_bits);

	for (uint32_t c = 0u; c < 4u; c++)
		pixel->gl[c] = gl[c];
	for (uint32_t c = 0u; c < 3u; c++)
		pixel->shadowed[c] = pixel->direct[c] = pixel->mirrored[c] = pixel->beauty[c] = gl[c];
	pixel->depth = depth_bits > 24u ? depth << 8 | depth >> 16 : depth;
	pixel->depth_exact = far ? (float)pixel->depth / (float)far : 1.0f;
	pixel->surface.order = SCENE_NONE;
	pixel->unknown = PIXEL_BEFORE;
}

/*
 * Tests of sec. 4.1.4 to 4.1.6, including their updates of the stencil and depth buffers. @return 1: the fragment is
 * drawn
 */
static inline int pixel_tests(GLOBAL const struct scene_material *m, GLOBAL const struct shaded *s,
                              GLOBAL struct frame_pixel *pixel, uint32_t bits)
{
	uint32_t steps = pixel_depth_steps(s->depth, pixel_depth_bits(bits));
	int use_stencil = m->stencil_test && pixel_stencil_bits(bits), pass;
	GLOBAL const struct scene_stencil *stencil = s->flags & SHADED_FRONT ? &m->stencil_front : &m->stencil_back;

	if ((use_stencil && stencil->func != GL_ALWAYS && pixel->unknown & PIXEL_UNKNOWN_STENCIL) ||
	    (m->depth_test && m->depth_func != GL_ALWAYS && pixel->unknown & PIXEL_UNKNOWN_DEPTH))
		pixel->unknown |= PIXEL_UNKNOWN_TEST;
	/* llvmpipe compares alpha in the frame buffer's precision. */
	if (m->alpha_test && !pixel_compare(m->alpha_func, m->floats ? pixel_order(s->gl[3]) : blend_round(s->gl[3]),
	                                    m->floats ? pixel_order(m->alpha_ref) : blend_round(m->alpha_ref)))
		return 0;
	/* Multisample fragment operations (sec. 4.1.3). The specification does not say which samples an alpha covers; these
	 * are llvmpipe's, for four samples. */
	if (m->samples_off >> pixel_sample(bits) & 1u ||
	    (m->alpha_to_coverage && !(s->gl[3] > 0.25f * (float)pixel_sample(bits))))
		return 0;
	if (use_stencil &&
	    !pixel_compare(stencil->func, stencil->ref & stencil->compare_mask, pixel->stencil & stencil->compare_mask)) {
		pixel->stencil = pixel_stencil_apply(stencil->fail, pixel->stencil, stencil->ref, stencil->write_mask,
		                                     pixel_stencil_bits(bits));
		return 0;
	}
	pass = !m->depth_test || !pixel_depth_bits(bits) || pixel_compare(m->depth_func, steps, pixel->depth);
	if (use_stencil)
		pixel->stencil = pixel_stencil_apply(pass ? stencil->zpass : stencil->zfail, pixel->stencil, stencil->ref,
		                                     stencil->write_mask, pixel_stencil_bits(bits));
	if (pass && m->depth_test && m->depth_write && pixel_depth_bits(bits)) {
		pixel->depth = steps;
		pixel->depth_exact = s->depth;
		pixel->unknown &= ~PIXEL_UNKNOWN_DEPTH;
	}
	return pass;
}

/* Store the channels that the colour mask allows. */
static inline void pixel_store(GLOBAL float *out, struct vec3 color, uint32_t mask)
{
	if (mask & 1u)
		out[0] = color.x;
	if (mask & 2u)
		out[1] = color.y;
	if (mask & 4u)
		out[2] = color.z;
}

/*
 * Blend a fragment's colour over a pixel's, at one of the steps from GL's colours to the beauty. alpha: the pixel's;
 * opaque: 1: it replaces the pixel's, whatever the material says
 */
static inline void pixel_part(GLOBAL const struct scene_material *m, GLOBAL const float *source, float source_alpha,
                              float alpha, GLOBAL float *destination, int opaque)
{
	struct vec4 s = v4(source[0], source[1], source[2], source_alpha);

	if (opaque && m->srgb && !m->floats)
		s = pixel_encoded(m, s, s, 0);
	else if (!opaque)
		s = pixel_source(m, s, v4(destination[0], destination[1], destination[2], alpha));
	pixel_store(destination, v3(s.x, s.y, s.z), m->color_mask);
}

/*
 * Test whether a fragment reaches a pixel's colour. The first sample's decision is stored for the samples that follow
 * it.
 */
static inline int pixel_passes(GLOBAL const struct scene_material *m, GLOBAL struct shaded *s,
                               GLOBAL struct frame_pixel *pixel, uint32_t bits)
{
	if (bits & PIXEL_FOLLOWS)
		return (s->flags & SHADED_DRAWN) != 0u;
	if (!pixel_tests(m, s, pixel, bits))
		return 0;
	s->flags |= SHADED_DRAWN;
	return 1;
}

/* Test whether a fragment changes a pixel's colours: runs all tests, including their updates of depth and stencil. */
static inline int pixel_reaches(GLOBAL const struct scene_material *m, GLOBAL struct shaded *s,
                                GLOBAL struct frame_pixel *pixel, uint32_t bits)
{
	if (s->flags & SHADED_STENCIL && bits & PIXEL_FOLLOWS)
		return 0;
	if (s->flags & SHADED_STENCIL) { /* DrawPixels of stencil values: only the mask matters (sec. 4.3.1) */
		uint32_t write = m->stencil_front.write_mask & pixel_bits_mask(pixel_stencil_bits(bits));

		pixel->stencil = (pixel->stencil & ~write) | ((uint32_t)s->depth & write);
		return 0;
	}
	return s->flags & SHADED_THERE && pixel_passes(m, s, pixel, bits) && m->color_mask & 15u;
}

/* Write the colours of a fragment that passed the tests. */
static inline void pixel_colors(GLOBAL const struct scene_material *m, GLOBAL const struct shaded *s,
                                GLOBAL struct frame_pixel *pixel, uint32_t bits)
{
	struct vec4 gl, old_gl = v4_load(pixel->gl);
	uint32_t mask = m->color_mask;
	float alpha = pixel_alpha_bits(bits) ? old_gl.w : 1.0f, opacity = m->alpha_to_one ? 1.0f : s->gl[3];

	gl = pixel_source(m, v4(s->gl[0], s->gl[1], s->gl[2], opacity), v4(old_gl.x, old_gl.y, old_gl.z, alpha));
	pixel_store(pixel->gl, v3(gl.x, gl.y, gl.z), mask);
	pixel_part(m, s->shadowed, opacity, alpha, pixel->shadowed, 0);
	if (!(m->surface.hidden & SCENE_LEFT_OUT)) {
		int solid = (m->surface.hidden & SCENE_SOLID) != 0u;

		pixel_part(m, s->direct, opacity, alpha, pixel->direct, solid);
		pixel_part(m, s->mirrored, opacity, alpha, pixel->mirrored, solid);
		/* Refractions are traced; blending would show them a second time. */
		pixel_part(m, s->beauty, opacity, alpha, pixel->beauty, solid || m->surface.transmit > 0.0f);
	}
	if (mask & 8u)
		pixel->gl[3] = gl.w;
}

/* 1 if a fragment leaves nothing of the previous colours: over black, grey and white it gives the same result. */
static inline int pixel_replaces(GLOBAL const struct scene_material *m, GLOBAL const struct shaded *s)
{
	const struct vec4 source = v4(s->gl[0], s->gl[1], s->gl[2], m->alpha_to_one ? 1.0f : s->gl[3]);
	struct vec4 over[3];

	for (int i = 0; i < 3; i++)
		over[i] = pixel_source(m, source, v4(0.5f * (float)i, 0.5f * (float)i, 0.5f * (float)i, 0.5f * (float)i));
	return over[0].x == over[1].x && over[1].x == over[2].x && over[0].y == over[1].y && over[1].y == over[2].y &&
	       over[0].z == over[1].z && over[1].z == over[2].z;
}

/* Record the other data of a fragment that reaches the pixel's colours. `draw`: its draw number */
static inline void pixel_mark(GLOBAL const struct scene_material *m, GLOBAL const struct shaded *s,
                              GLOBAL const struct fragment *f, uint32_t draw, GLOBAL struct frame_pixel *pixel)
{
	pixel->id = draw;
	if (m->blend && !m->logic_op)
		pixel->layers++;
	else if ((m->color_mask & 7u) == 7u && !m->logic_op)
		pixel->layers = 0u;
	if (pixel->unknown & PIXEL_UNKNOWN_COLOR && (m->color_mask & 7u) == 7u && pixel_replaces(m, s))
		pixel->unknown &= ~PIXEL_UNKNOWN_COLOR;
	/* A blended film without depth does not count as a surface, unless there is nothing else. */
	if (!m->blend || m->depth_write || pixel->surface.order == SCENE_NONE) {
		pixel->surface = *f;
		v3_store(pixel->albedo, v3_load(s->albedo));
	}
}

/* Run one fragment through all operations. */
static inline void pixel_draw(GLOBAL const struct scene_material *m, GLOBAL struct shaded *s,
                              GLOBAL const struct fragment *f, uint32_t draw, GLOBAL struct frame_pixel *pixel,
                              uint32_t bits)
{
	if (!pixel_reaches(m, s, pixel, bits))
		return;
	pixel_colors(m, s, pixel, bits);
	pixel_mark(m, s, f, draw, pixel);
}

/* --- Samples into pixels ----------------------------------------------------------------------------------------- */

/*
 * A channel of four samples as one number: the rounded mean of their 8-bit codes, in Mesa's order of operations
 * (22.3.6, util_make_fs_msaa_resolve). If all samples are equal, it is the first one's number, unchanged.
 */
static inline float pixel_average(const float *samples)
{
	float sum = 0.0f, first = M_RINT(clamp01(samples[0]) * 255.0f);
	int same = 1;

	for (int i = 0; i < 4; i++) {
		float code = M_RINT(clamp01(samples[i]) * 255.0f);

		same &= code == first;
		sum += code * (1.0f / 255.0f);
	}
	return same ? samples[0] : pixel_stored(sum * 0.25f);
}

/*
 * The mean of a part: the resolved colour plus the mean difference between the samples' parts and colours. Parts that
 * equal the colour stay equal.
 */
static inline float pixel_average_part(float gl, const float *gls, const float *parts)
{
	float off = (parts[0] - gls[0]) + (parts[1] - gls[1]) + (parts[2] - gls[2]) + (parts[3] - gls[3]);

	return M_MAX(gl + 0.25f * off, 0.0f);
}

/*
 * Resolve four samples of a pixel: the means of colours and parts, the albedo of the drawn samples, depth and stencil
 * of the first sample, and the surface of the first sample that has one.
 */
static inline void pixel_merge(GLOBAL const struct frame_pixel *first, GLOBAL const struct frame_pixel *second,
                               GLOBAL const struct frame_pixel *third, GLOBAL const struct frame_pixel *fourth,
                               GLOBAL struct frame_pixel *out)
{
	GLOBAL const struct frame_pixel *from[4];
	float gls[4], parts[4];
	struct vec3 albedo = v3(0.0f, 0.0f, 0.0f);
	uint32_t surface = 4u, drawn = 0u, unknown = 0u;

	*out = *first;
	from[0] = first;
	from[1] = second;
	from[2] = third;
	from[3] = fourth;
	for (uint32_t i = 0u; i < 4u; i++) {
		unknown |= from[i]->unknown;
		if (from[i]->id == 0u)
			continue;
		surface = surface < 4u ? surface : i;
		albedo = v3_add(albedo, v3_load(from[i]->albedo));
		drawn++;
	}
	for (uint32_t c = 0u; c < 4u; c++) {
		float gl;

		for (uint32_t i = 0u; i < 4u; i++)
			gls[i] = from[i]->gl[c];
		gl = pixel_average(gls);
		for (uint32_t part = 0u; part < 4u && c < 3u; part++) {
			for (uint32_t i = 0u; i < 4u; i++)
				parts[i] = part == 0u ? from[i]->shadowed[c] : part == 1u ? from[i]->direct[c] :
				           part == 2u ? from[i]->mirrored[c] : from[i]->beauty[c];
			*(part == 0u ? &out->shadowed[c] : part == 1u ? &out->direct[c] : part == 2u ? &out->mirrored[c] : &out->beauty[c]) =
				pixel_average_part(gl, gls, parts);
		}
		out->gl[c] = gl;
	}
	out->unknown = unknown;
	if (drawn == 0u)
		return;
	v3_store(out->albedo, v3_scale(albedo, 1.0f / (float)drawn));
	out->surface = from[surface]->surface;
	out->layers = from[surface]->layers;
	out->id = from[surface]->id;
}

/* Apply a clear (sec. 4.2.3) to a pixel: colours, depth and stencil as clear->buffers says. */
static inline void pixel_clear(const struct scene_clear *clear, GLOBAL struct frame_pixel *pixel, uint32_t bits)
{
	if (clear->buffers & 1u) {
		for (uint32_t c = 0u; c < 4u; c++) {
			if (!(clear->color_mask >> c & 1u))
				continue;
			pixel->gl[c] = clear->floats ? clear->color[c] : pixel_nudge(clamp01(clear->color[c]));
			if (c < 3u)
				pixel->shadowed[c] = pixel->direct[c] = pixel->mirrored[c] = pixel->beauty[c] = pixel->gl[c];
		}
		if ((clear->color_mask & 7u) == 7u) {
			pixel->id = 0u;
			pixel->layers = 0u;
			pixel->surface.order = SCENE_NONE;
			pixel->unknown &= ~(PIXEL_UNKNOWN_COLOR | PIXEL_BEFORE);
		}
	}
	if (clear->buffers & 2u) {
		pixel->depth = pixel_depth_steps(clear->depth, pixel_depth_bits(bits));
		pixel->depth_exact = clamp01(clear->depth);
		pixel->unknown &= ~PIXEL_UNKNOWN_DEPTH;
	}
	if (clear->buffers & 4u) {
		uint32_t top = pixel_bits_mask(pixel_stencil_bits(bits)), mask = clear->stencil_mask;

		pixel->stencil = (pixel->stencil & ~mask) | (clear->stencil & top & mask);
		pixel->unknown &= (mask & top) == top ? ~PIXEL_UNKNOWN_STENCIL : ~0u;
	}
}
