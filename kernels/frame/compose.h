/*
 * A finished frame as the planes of its picture, COMPOSE_LANES consecutive pixels a work item: one, unless who includes this says
 * otherwise. Loops over lanes have no branches, so that compilers do many at once.
 *
 * Beauty = gl x shadow + relight + reflect + refract holds for the numbers as they are stored: each part is rounded to
 * half before the next is computed from it, so what rounding leaves ends in relight and reflect.
 */
#pragma once

#include "kernels/gl/point.h"
#include "kernels/frame/sample.h"

#ifndef COMPOSE_LANES
#define COMPOSE_LANES 1u
#endif

/** Work items of compose_packet for a row of a picture. */
static inline uint32_t compose_columns(uint32_t width)
{
	return (width + COMPOSE_PACKET - 1u) / COMPOSE_PACKET;
}

/* --- Numbers ------------------------------------------------------------------------------------------------------ */

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

/* The rest of a sum, rounded as it is stored; what rounding alone leaves is no effect. */
static inline float compose_effect(float rest, float of)
{
	return M_ABS(rest) > M_ABS(of) * 0.001953125f ? compose_rounded(rest) : 0.0f;
}

/*
 * GL's number moved off the borders between two of the frame buffer's 8-bit codes by more than halves and the encoding change
 * it: whoever rounds it to 8 bits again gets the code that GL's own rounding gives.
 */
#define COMPOSE_CODE_REACH 0.43f /* of a code's half width of 0.5: a half of 0.5 and more is good to 1/16 of a code */

static inline float compose_nudged(float gl)
{
	float steps = gl * 255.0f, code = M_RINT(steps);

	float moved = (code + (steps > code ? COMPOSE_CODE_REACH : -COMPOSE_CODE_REACH)) / 255.0f;

	return gl >= 0.0f && gl <= 1.0f && M_ABS(steps - code) > COMPOSE_CODE_REACH ? moved : gl;
}

/* A pixel's colours, r g b each. */
#define COLOR_GL 0u
#define COLOR_SHADOWED 3u
#define COLOR_DIRECT 6u
#define COLOR_MIRRORED 9u
#define COLOR_BEAUTY 12u
#define COLOR_ALBEDO 15u
#define N_COLORS 18u

/* A work item's pixels, a number's lanes beside each other. */
struct compose_lanes {
	float display[N_COLORS][COMPOSE_LANES], color[N_COLORS][COMPOSE_LANES]; /* before and after encoding */
	float halves[N_COMPOSE_HALVES][COMPOSE_LANES], floats[N_COMPOSE_FLOATS][COMPOSE_LANES];
	uint32_t at[COMPOSE_LANES]; /* places in the planes */
};

/* One colour channel, taken apart. */
static inline void compose_channel(struct compose_lanes *l, uint32_t c)
{
	for (uint32_t k = 0u; k < COMPOSE_LANES; k++) {
		float exact = l->color[COLOR_GL + c][k], gl = compose_rounded(exact), shadowed = l->color[COLOR_SHADOWED + c][k];
		float direct = l->color[COLOR_DIRECT + c][k], share = shadowed / exact, shadow, relight, reflect, refract, sum;

		share = compose_rounded(share > 0.0f ? share : 0.0f);
		shadow = gl > 0.0f && shadowed < exact ? share : 1.0f;
		relight = compose_effect(direct - gl * shadow, direct);
		sum = gl * shadow + relight;
		reflect = compose_rounded(l->color[COLOR_MIRRORED + c][k] - sum);
		reflect = l->display[COLOR_MIRRORED + c][k] != l->display[COLOR_DIRECT + c][k] ? reflect : 0.0f;
		sum += reflect;
		refract = compose_rounded(l->color[COLOR_BEAUTY + c][k] - sum);
		refract = l->display[COLOR_BEAUTY + c][k] != l->display[COLOR_MIRRORED + c][k] ? refract : 0.0f;
		l->halves[COMPOSE_BEAUTY + c][k] = sum + refract;
		l->halves[COMPOSE_GL + c][k] = gl;
		l->halves[COMPOSE_SHADOW + c][k] = shadow;
		l->halves[COMPOSE_RELIGHT + c][k] = relight;
		l->halves[COMPOSE_REFLECT + c][k] = reflect;
		l->halves[COMPOSE_REFRACT + c][k] = refract;
		l->halves[COMPOSE_ALBEDO + c][k] = l->color[COLOR_ALBEDO + c][k];
	}
}

/* One number's lanes encoded. Those that stand for what the number before them stands for, as most do, are known already. */
static inline void compose_encode(struct compose_lanes *l, uint32_t i, uint32_t is_display)
{
	uint32_t differ = 0u;

	for (uint32_t k = 0u; k < COMPOSE_LANES; k++)
		differ |= i < 3u ? 1u : M_BITS(l->display[i][k]) ^ M_BITS(l->display[i - 3u][k]);
	for (uint32_t k = 0u; k < COMPOSE_LANES && (is_display || !differ); k++)
		l->color[i][k] = is_display ? l->display[i][k] : l->color[i - 3u][k];
	for (uint32_t k = 0u; k < COMPOSE_LANES && !is_display && differ; k++)
		l->color[i][k] = compose_linear(l->display[i][k]);
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

/* What a lane takes from its pixel: all but the colours' encoding and what follows from it. */
static inline void compose_load(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                GLOBAL const struct frame_pixel *pixel, GLOBAL const float *sums,
                                const struct compose_request *r, uint32_t k, struct compose_lanes *l)
{
	uint32_t drawn = pixel->id != 0u || pixel->unknown & PIXEL_BEFORE;
	struct fragment surface = pixel->surface;
	struct vec3 normal, position;

	compose_surface(t, windows, &surface, &normal, &position);
	for (uint32_t c = 0u; c < 3u; c++) {
		l->display[COLOR_GL + c][k] = pixel->gl[c];
		l->display[COLOR_SHADOWED + c][k] = pixel->shadowed[c];
		l->display[COLOR_DIRECT + c][k] = pixel->direct[c];
		l->display[COLOR_MIRRORED + c][k] = pixel->mirrored[c];
		l->display[COLOR_BEAUTY + c][k] = pixel->beauty[c];
		l->display[COLOR_ALBEDO + c][k] = drawn ? pixel->albedo[c] : 0.0f;
	}
	if (r->n_passes > 1u)
		for (uint32_t i = 0u; i < PASS_PARTS; i++)
			l->display[COLOR_SHADOWED + i][k] = (sums[i] + l->display[COLOR_SHADOWED + i][k]) / (float)r->n_passes;
	l->halves[COMPOSE_BEAUTY + 3u][k] = drawn ? 1.0f : 0.0f;
	l->halves[COMPOSE_GL + 3u][k] = pixel->gl[3];
	l->halves[COMPOSE_NORMAL][k] = normal.x;
	l->halves[COMPOSE_NORMAL + 1u][k] = normal.y;
	l->halves[COMPOSE_NORMAL + 2u][k] = normal.z;
	l->floats[COMPOSE_DEPTH][k] = pixel->depth_exact;
	l->floats[COMPOSE_Z][k] = -position.z;
	l->floats[COMPOSE_POSITION][k] = position.x;
	l->floats[COMPOSE_POSITION + 1u][k] = position.y;
	l->floats[COMPOSE_POSITION + 2u][k] = position.z;
	l->floats[COMPOSE_ID][k] = (float)pixel->id;
	l->floats[COMPOSE_LAYERS][k] = (float)pixel->layers;
}

/* GL's number goes off the borders between codes, and what equals it with it: no effect comes of it. */
static inline void compose_nudge(struct compose_lanes *l, uint32_t c)
{
	float gl[COMPOSE_LANES], nudged[COMPOSE_LANES];

	for (uint32_t k = 0u; k < COMPOSE_LANES; k++) {
		gl[k] = l->display[COLOR_GL + c][k];
		nudged[k] = compose_nudged(gl[k]);
	}
	for (uint32_t i = COLOR_GL + c; i < COLOR_ALBEDO; i += 3u)
		for (uint32_t k = 0u; k < COMPOSE_LANES; k++)
			l->display[i][k] = l->display[i][k] == gl[k] ? nudged[k] : l->display[i][k];
}

/* The normal as a colour, in place of GL's. */
static inline void compose_normals(struct compose_lanes *l)
{
	for (uint32_t k = 0u; k < COMPOSE_LANES; k++)
		for (uint32_t c = 0u; c < 3u; c++)
			l->display[COLOR_GL + c][k] =
				l->halves[COMPOSE_BEAUTY + 3u][k] > 0.0f ? l->halves[COMPOSE_NORMAL + c][k] * 0.5f + 0.5f : 0.0f;
}

/* Lanes to their planes: the first n of them. */
static inline void compose_store(const struct compose_lanes *l, const struct compose_request *r, uint32_t n, GLOBAL uint16_t *halves,
                                 GLOBAL float *floats)
{
	const uint32_t whole = n == COMPOSE_LANES && l->at[COMPOSE_LANES - 1u] == l->at[0] + COMPOSE_LANES - 1u; /* of one row */

	for (uint32_t i = 0u; i < N_COMPOSE_HALVES; i++) {
		GLOBAL uint16_t *plane = halves + r->half_plane[i] * r->width * r->height;

		if (r->half_plane[i] == SCENE_NONE)
			continue;
		for (uint32_t k = 0u; k < COMPOSE_LANES && whole; k++)
			plane[l->at[0] + k] = (uint16_t)compose_half(l->halves[i][k]);
		for (uint32_t k = 0u; k < n && !whole; k++)
			plane[l->at[k]] = (uint16_t)compose_half(l->halves[i][k]);
	}
	for (uint32_t i = 0u; i < N_COMPOSE_FLOATS; i++) {
		GLOBAL float *plane = floats + r->float_plane[i] * r->width * r->height;

		if (r->float_plane[i] == SCENE_NONE)
			continue;
		for (uint32_t k = 0u; k < COMPOSE_LANES && whole; k++)
			plane[l->at[0] + k] = l->floats[i][k];
		for (uint32_t k = 0u; k < n && !whole; k++)
			plane[l->at[k]] = l->floats[i][k];
	}
}

/* From pixels as they were loaded to numbers as they are stored. */
static inline void compose_colors(struct compose_lanes *l, const struct compose_request *r)
{
	for (uint32_t c = 0u; c < 3u; c++)
		compose_nudge(l, c);
	if (r->normals)
		compose_normals(l);
	for (uint32_t i = 0u; i < N_COLORS; i++)
		compose_encode(l, i, r->display);
	for (uint32_t c = 0u; c < 3u; c++)
		compose_channel(l, c);
	for (uint32_t c = 0u; c < 3u && r->normals; c++)
		for (uint32_t k = 0u; k < COMPOSE_LANES; k++)
			l->halves[COMPOSE_BEAUTY + c][k] = l->color[COLOR_GL + c][k];
}

/*
 * compose: pixels first .. first + COMPOSE_LANES - 1 of n, counted from the bottom row, into their planes. sums: what add_pass left
 * of the parts of all passes but this one; not looked at where there is but one.
 */
static inline void compose_item(const struct compose_arguments *a, uint32_t first)
{
	const struct compose_request *r = &a->request;
	struct compose_lanes l;

	for (uint32_t k = 0u; k < COMPOSE_LANES; k++) {
		uint32_t pixel = first + k < a->n ? first + k : a->n - 1u;

		l.at[k] = (r->height - 1u - pixel / r->width) * r->width + pixel % r->width;
		compose_load(&a->tables, a->windows, &a->frame[pixel], a->sums + (r->n_passes > 1u ? (a->first_pixel + pixel) * PASS_PARTS : 0u), r, k, &l);
	}
	compose_colors(&l, r);
	compose_store(&l, r, a->n - first < COMPOSE_LANES ? a->n - first : COMPOSE_LANES, a->halves, a->floats);
}

/* add_pass: the parts of one pass's pixels to the sums of all, of those of a turn. first: there are none yet. */
static inline void add_pass_item(const struct add_pass_arguments *a, uint32_t item)
{
	GLOBAL const struct frame_pixel *pixel = &a->frame[item];
	GLOBAL float *sum = a->sums + (a->first_pixel + item) * PASS_PARTS;

	if (sample_turn(a->first_pixel + item) != a->turn)
		return;
	for (uint32_t c = 0u; c < 3u; c++) {
		sum[c] = pixel->shadowed[c] + (a->first ? 0.0f : sum[c]);
		sum[3u + c] = pixel->direct[c] + (a->first ? 0.0f : sum[3u + c]);
		sum[6u + c] = pixel->mirrored[c] + (a->first ? 0.0f : sum[6u + c]);
		sum[9u + c] = pixel->beauty[c] + (a->first ? 0.0f : sum[9u + c]);
	}
}
