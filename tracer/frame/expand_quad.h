/*
 * Quads in the window, four corners and two triangles each: what lines, points and pixel rectangles become.
 */
#pragma once

#include "tracer/frame/expand.h"
#include "tracer/frame/expand_end.h"

/** Room for another quad. @return 0 or ERR_SYSTEM (reported) */
int expand_reserve_quad(const struct expand_input *in, struct expanded *out);

/** The nearest whole number; halves as llvmpipe rounds those of lines and points. */
int32_t expand_round(const struct expand_input *in, float x);

/** 1/256 pixel from the pixel corner, rounded so: a centre is 0 for llvmpipe. */
int32_t expand_snap(const struct expand_input *in, float pixels);

/** Add a corner of a quad. x, y: in 1/256 pixel, y down. */
void expand_add_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, int32_t x,
                       int32_t y);

/** A corner of a smooth quad: its place is not snapped for attributes. coverage: see GEOMETRY_SMOOTH_LINE */
void expand_add_smooth_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, float x,
                              float y, const float coverage[4]);

/** Two triangles over the last four corners, front side up. */
void expand_add_triangles(const struct expand_input *in, struct expanded *out, uint32_t draw);
