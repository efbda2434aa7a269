/*
 * Writes the frames that precede the ones kept in a new trace: keeps calls that create objects and state, and drops
 * those that only draw or end a frame (capture/gen/overlay.txt marks these; the recorder uses the marks too).
 *
 * Everything between NewList and EndList is kept. Executing a list may change state, so it is kept as well, but made to
 * draw nothing with RASTERIZER_DISCARD (GL 3.0 sec. 3.1). Begin and End are kept if such a list runs between them. Of
 * successive colours, normals and texture coordinates only the last before any other call is kept.
 *
 * Mesa (22.3) does not move the raster position for a bitmap that is discarded. A driver and this machine may differ if
 * such a bitmap is in a list and a later frame continues from its position.
 */
#pragma once

#include "replay/trace/trace_out.h"

struct early;

/** @return 0 or ERR_SYSTEM (reported). `out` is borrowed until early_destroy */
int early_create(struct early **e, struct trace_out *out);
void early_destroy(struct early **e);

/** Write a call, or drop it. @return 0; ERR_INPUT, ERR_SYSTEM (reported) */
int early_put(struct early *e, const struct call *call);

/** The frames to keep begin: restore state that was changed for the earlier ones. @return 0 or ERR_SYSTEM (reported) */
int early_end(struct early *e);

/** Number of calls written so far. */
uint64_t early_count(const struct early *e);
