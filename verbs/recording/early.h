/*
 * Frames that are left out of a trace: keeps their calls that make objects and state, and drops those that only draw or
 * end a frame (capture/gen/overlay.txt marks them, for the recorder as well).
 *
 * All between NewList and EndList is kept. A list that is executed may change state, so it runs, and draws nothing: it
 * runs with RASTERIZER_DISCARD (GL 3.0 sec. 3.1). Begin and End stay where such a list runs between them. Of colours,
 * normals and texture coordinates only the last before any other call is kept.
 *
 * Mesa (22.3) does not move the raster position by a bitmap that is discarded. A driver and this machine may differ
 * where such a bitmap stands in a list and a later frame goes on from its position.
 */
#pragma once

#include "replay/trace/trace_out.h"

struct early;

/** @return 0 or ERR_SYSTEM (reported). `out` is borrowed until early_destroy */
int early_create(struct early **e, struct trace_out *out);
void early_destroy(struct early **e);

/** Write a call, or leave it out. @return 0; ERR_INPUT, ERR_SYSTEM (reported) */
int early_put(struct early *e, const struct call *call);

/** The frames that are kept begin: restore what was switched for the others. @return 0 or ERR_SYSTEM (reported) */
int early_end(struct early *e);

/** Calls written so far. */
uint64_t early_count(const struct early *e);
