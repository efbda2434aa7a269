/*
 * Quads in the window, with four corners and two triangles each. Lines, points and pixel rectangles become quads.
 */
#pragma once

#include "tracer/frame/prepare/expand.h"
#include "tracer/frame/prepare/expand_end.h"

/** Make room for another quad. @return 0 or ERR_SYSTEM (reported) */
int expand_reserve_quad(const struct expand_input *in, struct expanded *out);

/** Round to the nearest whole number; halves are rounded as llvmpipe does for lines and points. */
int32_t expand_round(const struct expand_input *in, float x);

/** Snap to 1/256 pixel from the pixel corner, with expand_round. In llvmpipe a pixel centre is 0. */
int32_t expand_snap(const struct expand_input *in, float pixels);

/** Add a corner of a quad. x, y: in 1/256 pixel, y down. */
void expand_add_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, int32_t x,
                       int32_t y);

/** Add a corner of a smooth quad. Its position is not snapped for attributes. coverage: see GEOMETRY_SMOOTH_LINE */
void expand_add_smooth_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, float x,
                              float y, const float coverage[4]);

/** Add two triangles over the last four corners, front side up. */
void expand_add_triangles(const struct expand_input *in, struct expanded *out, uint32_t draw);
