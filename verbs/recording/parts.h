/*
 * What can be left out of a call that stays: primitives of a draw from arrays (in strips, as many at once as keep the
 * side of those behind them), and the texels of a texture image, which is then one whose content nobody gave.
 */
#pragma once

#include "replay/trace/trace_out.h"

/** How many parts a call has. 0: it stays as it is */
size_t parts_count(const struct call *call);

/** How many calls it becomes: a draw that lacks primitives becomes one for each run of those that stay. in:
 * [parts_count] */
size_t parts_calls(const struct call *call, const uint8_t *in);

/** Write it so. @return 0 or ERR_SYSTEM (reported) */
int parts_write(struct trace_out *out, const struct call *call, const uint8_t *in);
