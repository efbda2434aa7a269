/*
 * Converts a finished frame to the planes of its picture, one pixel per work item. compose_packet converts sixteen at
 * once (pack_compose.h).
 *
 * Beauty = gl x shadow + relight + reflect + refract holds for the numbers as they are stored: each part is rounded to
 * half before the next is computed from it, so rounding errors end up in relight and reflect.
 */
#pragma once

#include "kernels/encode.h"
#include "kernels/gl/point.h"
#include "kernels/frame/light/sample.h"

/*
 * Largest distance from a code's centre, in codes (borders are at 0.5). A half of 0.5 and more is accurate to 1/16 of a
 * code.
 */
#define COMPOSE_CODE_REACH 0.43f

#include "kernels/frame/stages/compose_lanes.h"

/* --- Planes ------------------------------------------------------------------------------------------------------ */

/* A pixel's colours, r g b each. */
#define COLOR_GL 0u
#define COLOR_SHADOWED 3u
#define COLOR_DIRECT 6u
#define COLOR_MIRRORED 9u
#define COLOR_BEAUTY 12u
#define COLOR_ALBEDO 15u
#define N_COLORS 18u

/* A pixel while it is composed. */
struct compose_pixel {
	float display[N_COLORS], color[N_COLORS]; /* before and after encoding */
	float halves[N_COMPOSE_HALVES], floats[N_COMPOSE_FLOATS];
};

/* Decompose one colour channel. */
static inline void compose_channel(struct compose_pixel *p, uint32_t c)
{
	float exact = p->color[COLOR_GL + c], gl = compose_rounded(exact), shadowed = p->color[COLOR_SHADOWED + c];
	float direct = p->color[COLOR_DIRECT + c], share = shadowed / exact, shadow, relight, reflect, refract, sum;

	share = compose_rounded(share > 0.0f ? share : 0.0f);
	shadow = gl > 0.0f && shadowed < exact ? share : 1.0f;
	relight = compose_effect(direct - gl * shadow, direct);
	sum = gl * shadow + relight;
	reflect = compose_rounded(p->color[COLOR_MIRRORED + c] - sum);
	reflect = p->display[COLOR_MIRRORED + c] != p->display[COLOR_DIRECT + c] ? reflect : 0.0f;
	sum += reflect;
	refract = compose_rounded(p->color[COLOR_BEAUTY + c] - sum);
	refract = p->display[COLOR_BEAUTY + c] != p->display[COLOR_MIRRORED + c] ? refract : 0.0f;
	p->halves[COMPOSE_BEAUTY + c] = sum + refract;
	p->halves[COMPOSE_GL + c] = gl;
	p->halves[COMPOSE_SHADOW + c] = shadow;
	p->halves[COMPOSE_RELIGHT + c] = relight;
	p->halves[COMPOSE_REFLECT + c] = reflect;
	p->halves[COMPOSE_REFRACT + c] = refract;
	p->halves[COMPOSE_ALBEDO + c] = p->color[COLOR_ALBEDO + c];
}

/* Encode one value. Most equal the value before them, whose encoding is already known. */
static inline void compose_encode(struct compose_pixel *p, uint32_t i, uint32_t is_display)
{
	if (is_display)
		p->color[i] = p->display[i];
	else if (i >= 3u && M_BITS(p->display[i]) == M_BITS(p->display[i - 3u]))
		p->color[i] = p->color[i - 3u];
	else
		p->color[i] = encode_linear(p->display[i]);
}

/* Position of a pixel's visible surface; all 0 if there is none. */
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

/* A part of a pass as it is summed: light if paths were followed, else GL's number. */
static inline float compose_part(float display, uint32_t radiant)
{
	return radiant ? encode_linear(display) : display;
}

/* Load a pixel: everything except the colours' encoding and what follows from it. */
static inline void compose_load(const struct compose_arguments *a, GLOBAL const struct frame_pixel *pixel,
                                uint32_t number, struct compose_pixel *p)
{
	uint32_t drawn = pixel->id != 0u || pixel->unknown & PIXEL_BEFORE;
	struct fragment surface = pixel->surface;
	struct vec3 normal, position;

	compose_surface(&a->tables, a->windows, &surface, &normal, &position);
	for (uint32_t c = 0u; c < 3u; c++) {
		p->display[COLOR_GL + c] = pixel->gl[c];
		p->display[COLOR_SHADOWED + c] = pixel->shadowed[c];
		p->display[COLOR_DIRECT + c] = pixel->direct[c];
		p->display[COLOR_MIRRORED + c] = pixel->mirrored[c];
		p->display[COLOR_BEAUTY + c] = pixel->beauty[c];
		p->display[COLOR_ALBEDO + c] = drawn ? pixel->albedo[c] : 0.0f;
	}
	for (uint32_t i = 0u; i < PASS_PARTS && a->request.n_passes > 1u; i++) {
		float sum = a->sums[(a->first_pixel + number) * PASS_PARTS + i] +
		            compose_part(p->display[COLOR_SHADOWED + i], a->request.radiant);
		float mean = sum / (float)a->request.n_passes;

		p->display[COLOR_SHADOWED + i] = a->request.radiant ? encode_display(mean) : mean;
	}
	p->halves[COMPOSE_BEAUTY + 3u] = drawn ? 1.0f : 0.0f;
	p->halves[COMPOSE_GL + 3u] = pixel->gl[3];
	p->halves[COMPOSE_NORMAL] = normal.x;
	p->halves[COMPOSE_NORMAL + 1u] = normal.y;
	p->halves[COMPOSE_NORMAL + 2u] = normal.z;
	p->floats[COMPOSE_DEPTH] = pixel->depth_exact;
	p->floats[COMPOSE_Z] = -position.z;
	p->floats[COMPOSE_POSITION] = position.x;
	p->floats[COMPOSE_POSITION + 1u] = position.y;
	p->floats[COMPOSE_POSITION + 2u] = position.z;
	p->floats[COMPOSE_ID] = (float)pixel->id;
	p->floats[COMPOSE_LAYERS] = (float)pixel->layers;
}

/*
 * Move GL's number off the borders between codes, and all values that equal it along with it, so that no effect
 * results.
 */
static inline void compose_nudge(struct compose_pixel *p, uint32_t c)
{
	const float gl = p->display[COLOR_GL + c], nudged = compose_nudged(gl);

	for (uint32_t i = COLOR_GL + c; i < COLOR_ALBEDO; i += 3u)
		p->display[i] = p->display[i] == gl ? nudged : p->display[i];
}

/* From pixels as loaded to numbers as stored. */
static inline void compose_colors(struct compose_pixel *p, const struct compose_request *r)
{
	for (uint32_t c = 0u; c < 3u; c++)
		compose_nudge(p, c);
	for (uint32_t c = 0u; c < 3u && r->normals; c++) /* the normal as a colour, replacing GL's */
		p->display[COLOR_GL + c] = p->halves[COMPOSE_BEAUTY + 3u] > 0.0f ? p->halves[COMPOSE_NORMAL + c] * 0.5f + 0.5f : 0.0f;
	for (uint32_t i = 0u; i < N_COLORS; i++)
		compose_encode(p, i, r->display);
	for (uint32_t c = 0u; c < 3u; c++)
		compose_channel(p, c);
	for (uint32_t c = 0u; c < 3u && r->normals; c++)
		p->halves[COMPOSE_BEAUTY + c] = p->color[COLOR_GL + c];
}

/* Store a pixel's numbers at an index in the planes. */
static inline void compose_store(const struct compose_pixel *p, const struct compose_request *r, uint32_t at,
                                 GLOBAL uint16_t *halves, GLOBAL float *floats)
{
	for (uint32_t i = 0u; i < N_COMPOSE_HALVES; i++)
		if (r->half_plane[i] != SCENE_NONE)
			halves[r->half_plane[i] + at] = (uint16_t)compose_half(p->halves[i]);
	for (uint32_t i = 0u; i < N_COMPOSE_FLOATS; i++)
		if (r->float_plane[i] != SCENE_NONE)
			floats[r->float_plane[i] + at] = p->floats[i];
}

/*
 * Compose a pixel, given by its number in the band, into the planes. a->sums: the parts of all other passes, as
 * add_pass summed them; ignored if there is only one pass.
 */
static inline void compose_one(const struct compose_arguments *a, GLOBAL const struct frame_pixel *pixel,
                               uint32_t number, uint32_t at)
{
	struct compose_pixel p;

	compose_load(a, pixel, number, &p);
	compose_colors(&p, &a->request);
	compose_store(&p, &a->request, at, a->halves, a->floats);
}

/** Work items of compose_packet for a band of `height` rows. */
static inline uint32_t compose_items(uint32_t width, uint32_t height)
{
	return frame_columns(width) * ((height + COMPOSE_ROWS - 1u) / COMPOSE_ROWS);
}

/* Index in the planes, which start with the top row, of a pixel of the band, whose rows count from the bottom. */
static inline uint32_t compose_at(const struct compose_request *r, uint32_t number)
{
	return (r->height - 1u - number / r->width) * r->width + number % r->width;
}

static inline void compose_item(const struct compose_arguments *a, uint32_t item)
{
	compose_one(a, &a->frame[item], item, compose_at(&a->request, item));
}

/*
 * add_pass: adds the parts of one pass to the sums of all, for the pixels of a turn. first: 1: nothing has been summed
 * yet.
 */
static inline void add_pass_item(const struct add_pass_arguments *a, uint32_t item)
{
	GLOBAL const struct frame_pixel *pixel = &a->frame[item];
	GLOBAL float *sum = a->sums + (a->first_pixel + item) * PASS_PARTS;

	if (!sample_takes_part(a->first_pixel + item, a->turn))
		return;
	for (uint32_t c = 0u; c < 3u; c++) {
		sum[c] = compose_part(pixel->shadowed[c], a->radiant) + (a->first ? 0.0f : sum[c]);
		sum[3u + c] = compose_part(pixel->direct[c], a->radiant) + (a->first ? 0.0f : sum[3u + c]);
		sum[6u + c] = compose_part(pixel->mirrored[c], a->radiant) + (a->first ? 0.0f : sum[6u + c]);
		sum[9u + c] = compose_part(pixel->beauty[c], a->radiant) + (a->first ? 0.0f : sum[9u + c]);
	}
}
