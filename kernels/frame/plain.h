/*
 * plain, plain_shadow, plain_whole, plain_program: frames that are cleared and drawn once, each pixel showing its
 * nearest fragment as it is: no blending, no mirrors, no pixels from before. Their pixels go from what the camera found
 * to the planes of the picture in one step.
 *
 * plain makes all planes without shadows, and a ray to each light that a fragment wants. plain_shadow makes planes
 * again where a light is dimmed. What they compute is what shade, resolve and compose do one after the other, to the
 * bit.
 *
 * Where light comes from all around (kernels/frame/dome.h), plain_dome sends all rays, and plain_shadow makes all
 * planes.
 *
 * plain_program runs before each of them where programs have a say: it leaves their fragments' colours in a->shaded.
 *
 * plain_whole does without rays, and looks for the fragments, too: camera_packet and plain in one.
 *
 * GPUs do the same in steps: plain_color, plain_ask and plain_show in place of plain; plain_color_dimmed and
 * plain_show_dimmed in place of plain_shadow. They know neither light from all around nor programs.
 *
 * Rays, and what is kept of fragments that are shaded one by one, stand block by block: PLAIN_WIDTH pixels of
 * PLAIN_ROWS rows of the band a work item.
 */
#pragma once

#include "kernels/camera/camera.h"
#include "kernels/frame/shadow.h"

/** How many blocks stand side by side. */
static inline uint32_t plain_columns(uint32_t width)
{
	return (width + PLAIN_WIDTH - 1u) / PLAIN_WIDTH;
}

/* Where the pixels of a row of a block stand among rays, and what else stands block by block. place: the block's, or
 * SCENE_NONE */
static inline uint32_t plain_base(uint32_t place, uint32_t y)
{
	return place == SCENE_NONE ? SCENE_NONE : (place * PLAIN_ROWS + y % PLAIN_ROWS) * PLAIN_WIDTH;
}

/* The place of a block, by a pixel of the band that lies in it. */
static inline uint32_t plain_place(GLOBAL const uint32_t *blocks, uint32_t width, uint32_t x, uint32_t y)
{
	return blocks[y / PLAIN_ROWS * plain_columns(width) + x / PLAIN_WIDTH];
}

/*
 * layered, layered_shadow, layered_mirror: frames of several looks, each at one segment's fragments: one a pixel, or
 * columns of up to CAMERA_COLUMN_MAX. All are drawn one over the other, in draw order, blended and tested. What shade,
 * resolve and compose do one after the other comes out, to the bit. A block has as many places as a pixel in it has
 * fragments at most, look by look.
 *
 * layered makes all planes without shadows and mirrors, and sends rays to lights. layered_shadow makes planes again
 * where a light is dimmed, and lists the fragments that mirror or let light through. layered_mirror makes the planes of
 * rows where these are, with what their paths found.
 *
 * Where more fragments lie over each other than a work item keeps, they come in rounds of looks: all but the last leave
 * pixels for the next in place of planes. A frame that begins with a picture goes on from where layered_start has left
 * that. Where a picture as GL's frame buffer has it is asked for, no round makes planes: layered_picture takes what the
 * last has left. The kernels and their twins keep pixels each in a layout of their own.
 */
#define PLAIN_LOOKS 8u   /* of a round, at most */
#define PLAIN_LAYERS 16u /* fragments of a round over each other, at most */
#define PLAIN_KEPT 31u   /* numbers that are kept of a pixel */

/* What a round is: bits. */
#define PLAIN_BEGINS 1u /* the first: pixels are as they were cleared */
#define PLAIN_ENDS 2u   /* the last: planes are made */
#define PLAIN_MIRRORED 4u /* light may have left fragments of an earlier one */
#define PLAIN_UNKNOWN 8u  /* of one that begins: what colours were there before is not known */

/* The three steps. */
#define PLAIN_FIRST 0u
#define PLAIN_SHADOW 1u
#define PLAIN_MIRROR 2u

static inline uint32_t plain_slots(uint32_t columns, uint32_t look)
{
	return columns >> look & 1u ? CAMERA_COLUMN_MAX : 1u;
}

/* Where the counts of a look begin, and by the number of its slots its fragments: no two looks' overlap. n_pixels: of
 * the band */
static inline uint32_t plain_look_first(uint32_t columns, uint32_t look, uint32_t n_pixels)
{
	return look * n_pixels * (CAMERA_COLUMN_MAX / plain_slots(columns, look));
}

/* Where pixels of a row are kept; x: a multiple of PLAIN_WIDTH. */
static inline uint32_t plain_kept(uint32_t width, uint32_t x, uint32_t y)
{
	return (y * plain_columns(width) * PLAIN_WIDTH + x) * PLAIN_KEPT;
}

/* How many blocks a band has. */
static inline uint32_t plain_blocks(uint32_t width, uint32_t height)
{
	return plain_columns(width) * ((height + PLAIN_ROWS - 1u) / PLAIN_ROWS);
}

/* The fragment of a pixel of the band; its order is SCENE_NONE where there is none. */
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

/* Where a pixel lies in the band, by its number: block by block. It may be beyond the last column or row. */
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

/* Whether a light does not reach a pixel's fragment whole. item: its place */
static inline int plain_is_dimmed(const struct plain_arguments *a, uint32_t x, uint32_t y, uint32_t item)
{
	return plain_has_fragment(a, x, y) && stage_dimmed(a->visibility, a->n_slots, a->n, item);
}

/* What shade_item takes, for fragments of a->fragments. n_slots: 0, or with visibility */
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

/* What shadow_ray_item takes, for the same ones. */
static inline struct shadow_ray_arguments plain_rays(const struct plain_arguments *a)
{
	const struct shadow_ray_arguments s = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels,
		.width = a->width, .shaded = a->shaded, .sample = 0u, .frame = 0u, .n = a->n, .n_rays = a->n * a->n_slots,
		.rays = a->rays,
	};

	return s;
}
