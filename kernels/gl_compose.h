/*
 * A finished frame as the planes of its picture: one work item a pixel.
 *
 * Beauty = gl x shadow + relight + reflect + refract holds for the numbers as they are stored: each part is rounded to
 * half before the next is computed from it, so what rounding leaves ends in relight and reflect.
 */
#ifndef KERNELS_GL_COMPOSE_H
#define KERNELS_GL_COMPOSE_H

#include "kernels/gl_fragment.h"
#include "kernels/sample.h"

/* --- Numbers, written without branches, so that compilers do many at once ------------------------------------------ */

/*
 * x^2.4 for 1e-30 < x < 1e15, to 5e-7 of itself, by nothing but what is the same on every device: log2 of the mantissa by its
 * series in (m - 1) / (m + 1), times 2.4, and 2 to that by its own series.
 */
static inline float compose_power(float x)
{
	uint32_t bits = M_BITS(x) - 0x3f3504f3u; /* mantissas from 1/sqrt(2) to sqrt(2) */
	float m = M_FLOAT((bits & 0x7fffffu) + 0x3f3504f3u), e = (float)((int)bits >> 23);
	float s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
	float log2m = s * (2.885390082f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * 0.412198583f)));
	float up = 2.4f * (e + log2m) + 12582912.0f, whole = up - 12582912.0f; /* 1.5 x 2^23: what is added is rounded */
	float f = (2.4f * e - whole) + 2.4f * log2m;
	float p = 1.0f + f * (0.6931471806f + f * (0.2402265070f + f * (0.0555041087f + f * (0.0096181291f +
	          f * (0.0013333558f + f * 0.0001540353f)))));

	return p * M_FLOAT((M_BITS(up) - 0x4b400000u + 127u) << 23);
}

/* sRGB's transfer function (IEC 61966-2-1): display-referred to linear light; odd. */
static inline float compose_linear(float display)
{
	float x = M_FLOAT(M_BITS(display) & 0x7fffffffu), large = x < 1.0e15f ? x : 1.0e15f;
	float y = compose_power((large + 0.055f) * 0.9478672986f);

	y = x > 0.04045f ? y : x * 0.0773993808f;
	return M_FLOAT(M_BITS(y) | (M_BITS(display) & 0x80000000u));
}

/* The bits of the nearest half, ties to even; beyond its range infinity. */
static inline uint32_t compose_half(float x)
{
	uint32_t bits = M_BITS(x), size = bits & 0x7fffffffu;
	uint32_t normal = (size - 0x38000000u + 0xfffu + (size >> 13 & 1u)) >> 13;
	uint32_t small = M_BITS(M_FLOAT(size) + 0.5f) - 0x3f000000u; /* subnormal: floats from a half on have the same steps */
	uint32_t odd = size > 0x7f800000u ? 0x7e00u : 0x7c00u;       /* 65536 and more, infinity, NaN */
	uint32_t finite = size < 0x38800000u ? small : normal;

	return (bits >> 16 & 0x8000u) | (size < 0x47800000u ? finite : odd);
}

/* A number as a half holds it; up to 65504. */
static inline float compose_rounded(float x)
{
	uint32_t bits = M_BITS(x), size = bits & 0x7fffffffu;
	uint32_t normal = (size + 0xfffu + (size >> 13 & 1u)) & ~0x1fffu;
	uint32_t small = M_BITS((M_FLOAT(size) + 0.5f) - 0.5f);

	return M_FLOAT((bits & 0x80000000u) | (size < 0x38800000u ? small : normal));
}

/* --- Planes ------------------------------------------------------------------------------------------------------- */

static inline void compose_store_float(GLOBAL float *floats, const struct compose_request *r, uint32_t plane, uint32_t at,
                                       float x)
{
	if (r->float_plane[plane] != SCENE_NONE)
		floats[r->float_plane[plane] * r->width * r->height + at] = x;
}

/* What is left to explain, rounded as it is stored; what rounding alone leaves is no effect. */
static inline float compose_effect(float rest, float of)
{
	return M_ABS(rest) > M_ABS(of) * 0.001953125f ? compose_rounded(rest) : 0.0f;
}

/*
 * GL's number moved off the borders between two of the frame buffer's 8-bit codes by more than halves and the encoding change
 * it: whoever rounds it to 8 bits again gets the code that GL's own rounding gives.
 */
#define COMPOSE_CODE_REACH 0.43f /* of a code's half width of 0.5: a half of 0.5 and more is good to 1/16 of a code */

static inline float compose_settled(float gl)
{
	float steps = gl * 255.0f, code = M_RINT(steps);

	if (!(gl >= 0.0f && gl <= 1.0f) || M_ABS(steps - code) <= COMPOSE_CODE_REACH)
		return gl;
	return (code + (steps > code ? COMPOSE_CODE_REACH : -COMPOSE_CODE_REACH)) / 255.0f;
}

/* A pixel's colours, r g b each. */
#define COLOR_GL 0
#define COLOR_SHADOWED 3
#define COLOR_DIRECT 6
#define COLOR_MIRRORED 9
#define COLOR_BEAUTY 12
#define COLOR_ALBEDO 15
#define N_COLORS 24 /* with room up to whole vectors */

#define COMPOSE_ROOM 32u /* N_COMPOSE_HALVES, likewise */

/* One colour channel of one pixel, taken apart. display, color: its colours before and after encoding. */
static inline void compose_channel(const float *display, const float *color, uint32_t c, float *out)
{
	float exact = color[COLOR_GL + c], gl = compose_rounded(exact), shadowed = color[COLOR_SHADOWED + c];
	float direct = color[COLOR_DIRECT + c], shadow = 1.0f, relight, reflect = 0.0f, refract = 0.0f, sum;

	if (gl > 0.0f && shadowed < exact)
		shadow = compose_rounded(M_MAX(shadowed / exact, 0.0f));
	relight = compose_effect(direct - gl * shadow, direct);
	sum = gl * shadow + relight;
	if (display[COLOR_MIRRORED + c] != display[COLOR_DIRECT + c])
		reflect = compose_rounded(color[COLOR_MIRRORED + c] - sum);
	sum += reflect;
	if (display[COLOR_BEAUTY + c] != display[COLOR_MIRRORED + c])
		refract = compose_rounded(color[COLOR_BEAUTY + c] - sum);
	out[COMPOSE_BEAUTY + c] = sum + refract;
	out[COMPOSE_GL + c] = gl;
	out[COMPOSE_SHADOW + c] = shadow;
	out[COMPOSE_RELIGHT + c] = relight;
	out[COMPOSE_REFLECT + c] = reflect;
	out[COMPOSE_REFRACT + c] = refract;
}

/* Where the visible surface of a pixel lies; all 0 where there is none. */
static inline void compose_surface(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                   const struct fragment *f, struct vec3 *normal, struct vec3 *position)
{
	struct point p;

	*normal = *position = v3(0.0f, 0.0f, 0.0f);
	if (f->order == SCENE_NONE)
		return;
	p = point_from_fragment(t, windows, f);
	*normal = point_normal(&p);
	*position = point_position(&p);
}

/*
 * compose: pixel `item`, counted from the bottom row, into its planes. sums: what add_pass left of the parts of all passes but
 * this one; not looked at where there is but one.
 */
static inline void compose_item(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                GLOBAL const struct frame_pixel *frame, GLOBAL const float *sums,
                                const struct compose_request *r, GLOBAL uint16_t *halves, GLOBAL float *floats,
                                uint32_t item)
{
	GLOBAL const struct frame_pixel *pixel = &frame[item];
	uint32_t at = (r->height - 1u - item / r->width) * r->width + item % r->width;
	uint32_t drawn = pixel->id != 0u || pixel->unknown & PIXEL_BEFORE;
	struct fragment surface = pixel->surface;
	float display[N_COLORS], color[N_COLORS], out[COMPOSE_ROOM];
	uint32_t bits[COMPOSE_ROOM];
	struct vec3 normal, position;

	for (uint32_t i = COLOR_ALBEDO; i < N_COLORS; i++)
		display[i] = 0.0f;
	for (uint32_t i = N_COMPOSE_HALVES; i < COMPOSE_ROOM; i++)
		out[i] = 0.0f;
	compose_surface(t, windows, &surface, &normal, &position);
	for (uint32_t c = 0u; c < 3u; c++) {
		display[COLOR_GL + c] = pixel->gl[c];
		display[COLOR_SHADOWED + c] = pixel->shadowed[c];
		display[COLOR_DIRECT + c] = pixel->direct[c];
		display[COLOR_MIRRORED + c] = pixel->mirrored[c];
		display[COLOR_BEAUTY + c] = pixel->beauty[c];
		display[COLOR_ALBEDO + c] = drawn ? pixel->albedo[c] : 0.0f;
	}
	if (r->n_passes > 1u)
		for (uint32_t i = 0u; i < PASS_PARTS; i++)
			display[COLOR_SHADOWED + i] = (sums[item * PASS_PARTS + i] + display[COLOR_SHADOWED + i]) / (float)r->n_passes;
	for (uint32_t c = 0u; c < 3u; c++) { /* what equals GL's number goes with it: no effect comes of it */
		float gl = display[COLOR_GL + c], settled = compose_settled(gl);

		for (uint32_t i = COLOR_GL; i < COLOR_ALBEDO; i += 3u)
			display[i + c] = display[i + c] == gl ? settled : display[i + c];
	}
	if (r->normals) {
		display[COLOR_GL] = drawn ? normal.x * 0.5f + 0.5f : 0.0f;
		display[COLOR_GL + 1] = drawn ? normal.y * 0.5f + 0.5f : 0.0f;
		display[COLOR_GL + 2] = drawn ? normal.z * 0.5f + 0.5f : 0.0f;
	}
	for (uint32_t i = 0u; i < N_COLORS; i++)
		color[i] = r->display ? display[i] : compose_linear(display[i]);
	for (uint32_t c = 0u; c < 3u; c++) {
		compose_channel(display, color, c, out);
		if (r->normals)
			out[COMPOSE_BEAUTY + c] = color[COLOR_GL + c];
		out[COMPOSE_ALBEDO + c] = color[COLOR_ALBEDO + c];
	}
	out[COMPOSE_BEAUTY + 3u] = drawn ? 1.0f : 0.0f;
	out[COMPOSE_GL + 3u] = pixel->gl[3];
	out[COMPOSE_NORMAL] = normal.x;
	out[COMPOSE_NORMAL + 1u] = normal.y;
	out[COMPOSE_NORMAL + 2u] = normal.z;
	for (uint32_t i = 0u; i < COMPOSE_ROOM; i++)
		bits[i] = compose_half(out[i]);
	for (uint32_t i = 0u; i < N_COMPOSE_HALVES; i++)
		if (r->half_plane[i] != SCENE_NONE)
			halves[r->half_plane[i] * r->width * r->height + at] = (uint16_t)bits[i];
	compose_store_float(floats, r, COMPOSE_DEPTH, at, pixel->depth_exact);
	compose_store_float(floats, r, COMPOSE_Z, at, -position.z);
	compose_store_float(floats, r, COMPOSE_POSITION, at, position.x);
	compose_store_float(floats, r, COMPOSE_POSITION + 1u, at, position.y);
	compose_store_float(floats, r, COMPOSE_POSITION + 2u, at, position.z);
	compose_store_float(floats, r, COMPOSE_ID, at, (float)pixel->id);
	compose_store_float(floats, r, COMPOSE_LAYERS, at, (float)pixel->layers);
}

/* add_pass: the parts of one pass's pixels to the sums of all, of those of a turn. first: there are none yet. */
static inline void add_pass_item(GLOBAL const struct frame_pixel *frame, uint32_t turn, uint32_t first, GLOBAL float *sums,
                                 uint32_t item)
{
	GLOBAL const struct frame_pixel *pixel = &frame[item];
	GLOBAL float *sum = sums + item * PASS_PARTS;

	if (sample_turn(item) != turn)
		return;
	for (uint32_t c = 0u; c < 3u; c++) {
		sum[c] = pixel->shadowed[c] + (first ? 0.0f : sum[c]);
		sum[3u + c] = pixel->direct[c] + (first ? 0.0f : sum[3u + c]);
		sum[6u + c] = pixel->mirrored[c] + (first ? 0.0f : sum[6u + c]);
		sum[9u + c] = pixel->beauty[c] + (first ? 0.0f : sum[9u + c]);
	}
}

#endif
