/* Convert fixed-point arguments of OpenGL ES 1 (and OES_fixed_point) to the floats that handlers take. */
#pragma once

#include "capture/format/call.h"

enum { GLS_FIXED_ARGS = 8, GLS_FIXED_ITEMS = 16 };

/** Storage for a converted call. */
struct gls_fixed {
	struct call call;
	struct trace_value args[GLS_FIXED_ARGS], items[GLS_FIXED_ITEMS];
};

/**
 * The call with floats. Numbers that encode enumerants or booleans are not fixed point, nor are the texels of a crop
 * rectangle.
 * @param fixed  bit set of the arguments that are fixed point (gls_command)
 * @return stored in `room`, valid as long as it and `c`
 */
const struct call *gls_fixed_to_float(struct gls_fixed *room, const struct call *c, unsigned fixed);
