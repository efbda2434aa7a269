/*
 * camera_packet, camera_wide, camera_compressed: which primitives cover which pixels of one view. Included by C and OpenCL C.
 *
 * A pixel's ray runs from the unprojected near towards the unprojected far point of its centre, or of where else in
 * its pixels the view looks (view.sample; "centre" stands for either), through the view's top level and the instances'
 * trees; the boxes are widened by instance.pad. camera_packet sends the frustum around a tile's rays instead, a
 * pixel's hundredth wider. What they find are candidates: whether one covers a pixel is decided by GL's own rule on its
 * window vertices (GL 2.1 sec. 3.5.1), so that edges fall where the rasterizer puts them:
 *   - all three vertices have a place in the window: integer edge functions at the pixel centre in 1/256 pixel. A
 *     centre on an edge belongs to the triangle on its right, or above where the edge is level (as Mesa's llvmpipe has
 *     it for windows and for framebuffer objects), so that pixels on a shared edge are covered once.
 *   - else: the same on the parts that the view volume leaves of the triangle (kernels/gl/clip.h).
 * Screen instances (view.screen_first ..) are asked at the pixel centre as a point, whatever the projection.
 *
 * Pixels are numbered y * width + x, y from the bottom. Those outside of the view's rectangle (camera_rectangle) are
 * not touched.
 *
 * CAMERA_NEAREST_*: fragments[pixel] is the one of least window depth, in steps of 2^-24 (24-bit depth buffer); of
 * equals the first in draw order with LESS, the last with LEQUAL. order is SCENE_NONE where there is none.
 * A triangle seen edge-on covers pixels by its snapped vertices alone. Its plane gives the depth (kernels/gl/clip.h) and may stand
 * nearer there than any vertex, as in llvmpipe. Its box does not show that: where something lies before the box, it depends on the
 * tree whether such a fragment is found.
 * CAMERA_COLUMN: fragments[pixel * CAMERA_COLUMN_MAX ..] are the first CAMERA_COLUMN_MAX fragments whose order number is
 * at least after[pixel], ascending. A caller that wants all starts with after = 0 and goes on with the last order + 1
 * as long as CAMERA_COLUMN_MAX come.
 *
 * Window vertices with a place lie within +-2^23 (32768 pixels).
 *
 * Work items: camera_packet_items() tiles of 32 x 32 pixels, or for the others camera_wide_items() pixels, of the view's
 * rectangle.
 */
#ifndef KERNELS_CAMERA_CAMERA_H
#define KERNELS_CAMERA_CAMERA_H

#include "scene/scene.h"
#include "kernels/shared.h"

#define CAMERA_NEAREST_LESS 0u
#define CAMERA_NEAREST_LEQUAL 1u
#define CAMERA_COLUMN 2u

#define CAMERA_COLUMN_MAX 8
/* A tile is square; in pixels. */
#define CAMERA_TILE 32

/* A rectangle of pixels: x0 <= x < x1, y0 <= y < y1; empty ones have x0 == x1. */
struct camera_rectangle {
	int32_t x0, y0, x1, y1;
};

/** The pixels a view may touch: its scissor (int[4]: x y w h) cut to the drawable. */
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

/** How many work items a rectangle takes. */
static inline uint32_t camera_packet_items(struct camera_rectangle r)
{
	return (uint32_t)((r.x1 - r.x0 + CAMERA_TILE - 1) / CAMERA_TILE) *
	       (uint32_t)((r.y1 - r.y0 + CAMERA_TILE - 1) / CAMERA_TILE);
}

static inline uint32_t camera_wide_items(struct camera_rectangle r)
{
	return (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
}

#endif
