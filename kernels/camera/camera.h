/*
 * camera_packet, camera_wide, camera_compressed find which primitives cover which pixels of one view. Included by C and
 * OpenCL C.
 *
 * A pixel's ray runs from the unprojected near point towards the unprojected far point of its centre, or of the view's
 * sample position in the pixel (view.sample; below, "centre" means either). It goes through the view's TLAS and the
 * instances' BLASes, with boxes widened by instance.pad. camera_packet traverses with the frustum around a tile's rays
 * instead, widened by a hundredth of a pixel. The triangles found are only candidates. GL's own rule for window
 * vertices (GL 2.1 sec. 3.5.1) decides which of them cover a pixel, so edges fall exactly where a rasterizer puts them:
 *   - If all three vertices have a place in the window: integer edge functions at the pixel centre in 1/256 pixel. A
 *     centre on an edge belongs to the triangle on its right, or above a horizontal edge, as in Mesa's llvmpipe for
 *     windows and framebuffer objects. Pixels on a shared edge are covered once.
 *   - Otherwise: the same test on the parts of the clipped triangle (kernels/gl/clip.h).
 * Screen instances (view.screen_first ..) are tested at the pixel centre as a point, whatever the projection.
 *
 * Pixels are numbered y * width + x, y from the bottom. Pixel buffers begin with pixel number first_pixel, since each
 * band of the frame's rows has its own buffers. If the band starts further into the buffers, first_pixel is less by
 * that offset, modulo 2^32. Pixels outside the rectangle are not touched. The rectangle lies within the view's
 * (camera_rectangle).
 *
 * CAMERA_NEAREST_*: fragments[pixel] is the fragment of least window depth, compared in steps of 2^-24 (24-bit depth
 * buffer). Among equals, LESS keeps the first in draw order, LEQUAL the last. order is SCENE_NONE if there is none. A
 * triangle seen edge-on covers pixels only because its vertices are snapped. Its depth comes from its plane
 * (kernels/gl/clip.h) and may be nearer there than any vertex, as in llvmpipe. Its box does not include that depth, so
 * if something lies in front of the box, it depends on the tree whether such a fragment is found. CAMERA_COLUMN:
 * fragments[pixel * CAMERA_COLUMN_MAX ..] are the first CAMERA_COLUMN_MAX fragments with an order number of at least
 * after[pixel], ascending. To get all fragments, start with after = 0 and continue with the last order + 1 until fewer
 * than CAMERA_COLUMN_MAX are returned.
 *
 * Window vertices that have a place lie within +-2^23 (32768 pixels).
 *
 * Work items, for the rectangle: camera_packet_items() tiles of 32 x 32 pixels, or for the other kernels
 * camera_wide_items() pixels in blocks. Tiles are aligned to the frame, so a rectangle may cover part of a tile.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"

#define CAMERA_NEAREST_LESS 0u
#define CAMERA_NEAREST_LEQUAL 1u
#define CAMERA_COLUMN 2u

#define CAMERA_COLUMN_MAX 8
/* Width and height of a tile, in pixels. */
#define CAMERA_TILE 32

/** Pixels that a view may touch: its scissor (int[4]: x y w h) clipped to the drawable. */
static inline struct camera_rectangle camera_rectangle(int32_t x, int32_t y, int32_t w, int32_t h, uint32_t width,
                                                       uint32_t height)
{
	struct camera_rectangle r;

	r.x0 = x > 0 ? x : 0;
	r.y0 = y > 0 ? y : 0;
	r.x1 = x + w < (int32_t)width ? x + w : (int32_t)width;
	r.y1 = y + h < (int32_t)height ? y + h : (int32_t)height;
	if (r.x1 <= r.x0 || r.y1 <= r.y0)
		r.x1 = r.x0, r.y1 = r.y0;
	return r;
}

/** Number of tile columns that a rectangle touches. */
static inline uint32_t camera_packet_columns(struct camera_rectangle r)
{
	return (uint32_t)((r.x1 + CAMERA_TILE - 1) / CAMERA_TILE - r.x0 / CAMERA_TILE);
}

/** Number of work items for a rectangle. */
static inline uint32_t camera_packet_items(struct camera_rectangle r)
{
	if (r.x0 == r.x1)
		return 0u;
	return camera_packet_columns(r) * (uint32_t)((r.y1 + CAMERA_TILE - 1) / CAMERA_TILE - r.y0 / CAMERA_TILE);
}

/** First column and row of a work item's tile. */
static inline int32_t camera_packet_x(struct camera_rectangle r, uint32_t item)
{
	return (r.x0 / CAMERA_TILE + (int32_t)(item % camera_packet_columns(r))) * CAMERA_TILE;
}

static inline int32_t camera_packet_y(struct camera_rectangle r, uint32_t item)
{
	return (r.y0 / CAMERA_TILE + (int32_t)(item / camera_packet_columns(r))) * CAMERA_TILE;
}

/* A rectangle's pixels are grouped in blocks, so that work items that run in step trace similar rays. */
#define CAMERA_WIDE_WIDTH 8u
#define CAMERA_WIDE_HEIGHT 4u

static inline uint32_t camera_wide_columns(struct camera_rectangle r)
{
	return ((uint32_t)(r.x1 - r.x0) + CAMERA_WIDE_WIDTH - 1u) / CAMERA_WIDE_WIDTH;
}

/** Number of work items for a rectangle: all pixels of its blocks. */
static inline uint32_t camera_wide_items(struct camera_rectangle r)
{
	const uint32_t rows = ((uint32_t)(r.y1 - r.y0) + CAMERA_WIDE_HEIGHT - 1u) / CAMERA_WIDE_HEIGHT;

	return camera_wide_columns(r) * rows * CAMERA_WIDE_WIDTH * CAMERA_WIDE_HEIGHT;
}

/** A work item's pixel. It may lie beyond the rectangle's last column or row. r: not empty */
static inline int32_t camera_wide_x(struct camera_rectangle r, uint32_t item)
{
	const uint32_t block = item / (CAMERA_WIDE_WIDTH * CAMERA_WIDE_HEIGHT);

	return r.x0 + (int32_t)(block % camera_wide_columns(r) * CAMERA_WIDE_WIDTH + item % CAMERA_WIDE_WIDTH);
}

static inline int32_t camera_wide_y(struct camera_rectangle r, uint32_t item)
{
	const uint32_t block = item / (CAMERA_WIDE_WIDTH * CAMERA_WIDE_HEIGHT);

	return r.y0 + (int32_t)(block / camera_wide_columns(r) * CAMERA_WIDE_HEIGHT +
	                        item / CAMERA_WIDE_WIDTH % CAMERA_WIDE_HEIGHT);
}
