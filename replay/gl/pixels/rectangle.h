/* Rectangles of pixels as fragments (GL 2.1 sec. 3.6.4, 3.7). */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_state;

#define GLS_MAX_RECTANGLE 16384 /* pixels of a side */

struct gls_rectangle {
	uint32_t kind;          /* of pixels: SCENE_BITMAP, SCENE_*_PIXELS */
	uint32_t width, height;
	float left, low;        /* window coordinates of the first pixel's outer corner */
	float zoom[2];          /* pixels of the window for one of these */
	const uint8_t *texels;  /* [height][width], 4 bytes each, or 4 floats of SCENE_FLOAT_PIXELS; borrowed */
	uint32_t from_top;      /* as in struct scene_rectangle */
};

/** Draw with the raster position's colours, texture coordinates and distance; what else fragments go through is the
 * state's. */
void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r);

/** Draw depths whatever tests and colour mask say: only the mask of the depth buffer counts. */
void gls_draw_depths(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r);

/**
 * Copy to the surface in any render mode: nothing touches the fragments but the scissor.
 * @param color_mask  as in struct gls_color_buffer
 */
void gls_copy_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r, uint32_t color_mask);
