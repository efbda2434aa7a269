/*
 * Parts of a call that can be left out: primitives of a draw from arrays (for strips, in multiples that keep the
 * orientation of the rest), and the texels of a texture image, which is then specified without data.
 */
#pragma once

#include "replay/trace/trace_out.h"

/** Number of parts of a call. 0: it cannot be divided */
size_t parts_count(const struct call *call);

/**
 * Number of calls that it becomes: a draw without some primitives becomes one draw for each run of remaining ones. in:
 * [parts_count]
 */
size_t parts_calls(const struct call *call, const uint8_t *in);

/** Write the call with these parts only. @return 0 or ERR_SYSTEM (reported) */
int parts_write(struct trace_out *out, const struct call *call, const uint8_t *in);
