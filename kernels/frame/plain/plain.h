/*
 * plain, plain_shadow, plain_whole, plain_program: frames that are cleared and drawn once, where each pixel shows its
 * nearest fragment unchanged: no blending, no mirrors, no earlier pixels. Pixels go from the camera's fragments to the
 * picture's planes in one step.
 *
 * plain makes all planes without shadows, and a ray to each light that a fragment needs. plain_shadow redoes the planes
 * where a light is dimmed. The results are bit-identical to running shade, resolve and compose in sequence.
 *
 * If there is a dome (kernels/frame/dome/dome.h), plain_dome sends all rays, and plain_shadow makes all planes.
 *
 * If there are programs, plain_program runs before each of these and writes their fragments' colours to a->shaded.
 *
 * plain_whole is for frames without rays. It also finds the fragments: camera_packet and plain in one.
 *
 * GPUs do the same in steps: plain_color, plain_ask and plain_show replace plain; plain_color_dimmed and
 * plain_show_dimmed replace plain_shadow. These support neither a dome nor programs.
 *
 * Rays, and the data of fragments that are shaded one by one, are stored block by block: one work item handles
 * PLAIN_WIDTH pixels of PLAIN_ROWS rows of the band.
 */
#pragma once

#include "kernels/camera/camera.h"
#include "kernels/frame/light/shadow.h"

/** Number of blocks side by side. */
static inline uint32_t plain_columns(uint32_t width)
{
	return (width + PLAIN_WIDTH - 1u) / PLAIN_WIDTH;
}

/* Index of a row of a block's pixels among rays and other data stored block by block. place: the block's, or
 * SCENE_NONE */
static inline uint32_t plain_base(uint32_t place, uint32_t y)
{
	return place == SCENE_NONE ? SCENE_NONE : (place * PLAIN_ROWS + y % PLAIN_ROWS) * PLAIN_WIDTH;
}

/* The place of the block that contains a pixel of the band. */
static inline uint32_t plain_place(GLOBAL const uint32_t *blocks, uint32_t width, uint32_t x, uint32_t y)
{
	return blocks[y / PLAIN_ROWS * plain_columns(width) + x / PLAIN_WIDTH];
}

/*
 * layered, layered_shadow, layered_mirror: frames of several looks. Each look fetches one segment's fragments: one per
 * pixel, or columns of up to CAMERA_COLUMN_MAX. All are tested and blended over each other in draw order, with results
 * that are bit-identical to running shade, resolve and compose in sequence. For each look, a block has as many places
 * as the largest number of fragments in any of its pixels.
 *
 * layered makes all planes without shadows and mirrors, and sends rays to lights. layered_shadow redoes the planes
 * where a light is dimmed, and lists the fragments that mirror or transmit light. layered_mirror makes the planes of
 * rows with such fragments, including what their paths found.
 *
 * If more fragments overlap than a work item can hold, they are processed in rounds of looks: every round but the last
 * passes pixels on to the next instead of making planes. A frame that begins with a picture continues from the pixels
 * that layered_start prepared. If a picture in the format of GL's frame buffer is wanted, no round makes planes;
 * layered_picture converts the last round's pixels. The kernels and their twins store pixels in different layouts.
 */
#define PLAIN_LOOKS 8u   /* maximum in a round */
#define PLAIN_LAYERS 16u /* maximum number of overlapping fragments in a round */
#define PLAIN_KEPT 31u   /* numbers stored per pixel */

/* Properties of a round: bits. */
#define PLAIN_BEGINS 1u /* the first round: pixels start from the clear values */
#define PLAIN_ENDS 2u   /* the last round: planes are made */
#define PLAIN_MIRRORED 4u /* light may have left fragments of an earlier round */
#define PLAIN_UNKNOWN 8u  /* in a first round: the colours from before are not known */

/* The three steps. */
#define PLAIN_FIRST 0u
#define PLAIN_SHADOW 1u
#define PLAIN_MIRROR 2u

static inline uint32_t plain_slots(uint32_t columns, uint32_t look)
{
	return columns >> look & 1u ? CAMERA_COLUMN_MAX : 1u;
}

/* Start of a look's counts and, times the number of its slots, of its fragments. No two looks overlap. n_pixels: of the
 * band */
static inline uint32_t plain_look_first(uint32_t columns, uint32_t look, uint32_t n_pixels)
{
	return look * n_pixels * (CAMERA_COLUMN_MAX / plain_slots(columns, look));
}

/* Index of a row's stored pixels; x: a multiple of PLAIN_WIDTH. */
static inline uint32_t plain_kept(uint32_t width, uint32_t x, uint32_t y)
{
	return (y * plain_columns(width) * PLAIN_WIDTH + x) * PLAIN_KEPT;
}

/* Number of blocks in a band. */
static inline uint32_t plain_blocks(uint32_t width, uint32_t height)
{
	return plain_columns(width) * ((height + PLAIN_ROWS - 1u) / PLAIN_ROWS);
}

/* The fragment of a pixel of the band; its order is SCENE_NONE if there is none. */
static inline struct fragment plain_fragment(const struct plain_arguments *a, uint32_t x, uint32_t y)
{
	struct fragment none;

	none.order = none.instance = none.primitive = SCENE_NONE;
	none.b1 = none.b2 = none.depth = 0.0f;
	if ((int32_t)x < a->rectangle.x0 || (int32_t)x >= a->rectangle.x1 || (int32_t)y < a->rectangle.y0 ||
	    (int32_t)y >= a->rectangle.y1)
		return none;
	return a->sparse[y * a->width + x];
}

/* Position in the band of a pixel number, counted block by block. It may be beyond the last column or row. */
static inline uint32_t plain_x(uint32_t width, uint32_t number)
{
	return number / (PLAIN_WIDTH * PLAIN_ROWS) % plain_columns(width) * PLAIN_WIDTH + number % PLAIN_WIDTH;
}

static inline uint32_t plain_y(uint32_t width, uint32_t number)
{
	return number / (PLAIN_WIDTH * PLAIN_ROWS) / plain_columns(width) * PLAIN_ROWS + number / PLAIN_WIDTH % PLAIN_ROWS;
}

static inline int plain_is_outside(const struct plain_arguments *a, uint32_t x, uint32_t y)
{
	return x >= a->width || y >= a->request.height;
}

static inline int plain_has_fragment(const struct plain_arguments *a, uint32_t x, uint32_t y)
{
	return !plain_is_outside(a, x, y) && plain_fragment(a, x, y).order != SCENE_NONE;
}

/* Test whether some light does not fully reach a pixel's fragment. item: its place */
static inline int plain_is_dimmed(const struct plain_arguments *a, uint32_t x, uint32_t y, uint32_t item)
{
	return plain_has_fragment(a, x, y) && stage_dimmed(a->visibility, a->n_slots, a->n, item);
}

/* Arguments of shade_item for fragments in a->fragments. n_slots: 0, or with visibility */
static inline struct shade_arguments plain_shading(const struct plain_arguments *a, uint32_t n_slots)
{
	const struct shade_arguments s = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels,
		.width = a->width, .height = a->height, .bits = a->bits, .visibility = a->visibility, .n_slots = n_slots,
		.transport = TRANSPORT_GL, .albedo = a->request.half_plane[COMPOSE_ALBEDO] != SCENE_NONE, .n = a->n,
		.programs = a->programs, .shaded = a->shaded,
	};

	return s;
}

/* Arguments of shadow_ray_item for the same fragments. */
static inline struct shadow_ray_arguments plain_rays(const struct plain_arguments *a)
{
	const struct shadow_ray_arguments s = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels,
		.width = a->width, .shaded = a->shaded, .sample = 0u, .frame = 0u, .n = a->n, .n_rays = a->n * a->n_slots,
		.rays = a->rays,
	};

	return s;
}
