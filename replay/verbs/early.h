/*
 * Calls of frames that are left out of a trace, as far as they make objects and state: all but what does nothing but draw or end
 * a frame (capture/gen/overlay.txt, by which the recorder, too, leaves frames out).
 *
 * What stands between NewList and EndList is kept whole. Where such lists are executed they change state and must run; they draw
 * nothing, as they run with RASTERIZER_DISCARD (GL 3.0 sec. 3.1). Begin and End stay where such a list runs between them. Of
 * colours, normals and texture coordinates only the last ones before some other call are kept.
 *
 * Mesa moves no raster position by a bitmap that is discarded (22.3): one that stands in a list and moves a position that a later
 * frame goes on from is where a driver and this machine may part.
 */
#ifndef REPLAY_VERBS_EARLY_H
#define REPLAY_VERBS_EARLY_H

#include "replay/trace/trace_out.h"

struct early;

/** @return 0 or ERR_SYSTEM (reported). `out` is borrowed until early_destroy */
int early_create(struct early **e, struct trace_out *out);
void early_destroy(struct early **e);

/** Write a call, or leave it out. @return 0; ERR_INPUT, ERR_SYSTEM (reported) */
int early_put(struct early *e, const struct call *call);

/** The frames that are kept begin: all is as the program had it. @return 0 or ERR_SYSTEM (reported) */
int early_end(struct early *e);

/** Calls written so far. */
uint64_t early_count(const struct early *e);

#endif
