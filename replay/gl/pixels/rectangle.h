/* Draws rectangles of pixels (GL 2.1 sec. 3.6.4, 3.7): each is an event of one point, with the pixels as a picture. */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_state;

#define GLS_MAX_RECTANGLE 16384 /* pixels per side */

struct gls_rectangle {
	uint32_t kind;          /* SCENE_BITMAP, SCENE_*_PIXELS */
	uint32_t width, height;
	float left, low;        /* window coordinates of the first pixel's outer corner */
	float zoom[2];          /* window pixels per pixel of the rectangle */
	const uint8_t *texels;  /* [height][width], 4 bytes each, or 4 floats for SCENE_FLOAT_PIXELS; borrowed for the
	                           call */
	uint32_t from_top;      /* as in struct scene_rectangle */
};

/**
 * Draw a rectangle with the colours, texture coordinates and depth of the raster position; fragment operations as the
 * state says. Does nothing unless draws reach a surface (gls_is_drawn).
 */
void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r);

/** Draw depths. They pass all tests and write no colours; only the depth mask applies. */
void gls_draw_depths(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r);

/**
 * Copy to the surface in any render mode; only the scissor affects the fragments.
 * @param color_mask  as in struct gls_color_buffer
 */
void gls_copy_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r, uint32_t color_mask);
