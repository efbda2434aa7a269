/* Fixed-point arguments of OpenGL ES 1 (and OES_fixed_point) as the floats that handlers take. */
#pragma once

#include "capture/format/call.h"

enum { GLS_FIXED_ARGS = 8, GLS_FIXED_ITEMS = 16 };

/** Room for a changed call. */
struct gls_fixed {
	struct call call;
	struct trace_value args[GLS_FIXED_ARGS], items[GLS_FIXED_ITEMS];
};

/**
 * The call with floats. Numbers that stand for enumerants or truth values are no fixed point, nor are texels of a crop
 * rectangle.
 * @param fixed  bits of the arguments that are fixed point (gls_command)
 * @return in `room`, valid as long as it and `c`
 */
const struct call *gls_fixed_to_float(struct gls_fixed *room, const struct call *c, unsigned fixed);
