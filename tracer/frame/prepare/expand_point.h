/*
 * Points as squares (GL 2.1 sec. 3.3), with or without multisampling, and bitmaps and pixel rectangles (sec. 3.6.4,
 * 3.7), at the positions of Mesa's llvmpipe.
 */
#pragma once

#include "tracer/frame/prepare/expand_end.h"

/** Add a point if its centre is in the view. @param offset  added to its depth. @return 0 or ERR_SYSTEM (reported) */
int expand_point(const struct expand_input *in, struct expanded *out, struct expand_end e, float offset, uint32_t draw);

/** The same for a polygon's corner, which has been clipped with its polygon. */
int expand_corner(const struct expand_input *in, struct expanded *out, struct expand_end e, float offset,
                  uint32_t draw);

/** Add a bitmap or pixel rectangle. Its first corner is vertex i of the mesh, in window coordinates. @return 0 or
 * ERR_SYSTEM (reported) */
int expand_rectangle(const struct expand_input *in, struct expanded *out, uint32_t i, uint32_t draw);
