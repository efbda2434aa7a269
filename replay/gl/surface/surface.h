/*
 * Surfaces: targets of draws, and their pixels if something needs them.
 *
 * Only the supplier (replay.h) renders. A surface stores its events, and its contents before them.
 */
#pragma once

#include "replay/build/frame.h"

/**
 * The pixels of a surface after all events so far.
 * @param area  the part that is read; other pixels need not be correct; NULL: all
 * @return borrowed, valid until the surface's next event; NULL: not available (counted, or x->feedback.rewind is set)
 */
const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface,
                                             const struct gls_area *area);

/**
 * Restart the same events from another picture (takes the reference), for the next of several buffers.
 * @return 1; 0: earlier contents do not show, and no program writes different colours to different buffers
 */
int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture);

/**
 * End the surface's scene: later events start from its result.
 * @param is_shown  1: it is returned as a frame
 * @return a reference for the caller; NULL: as gls_surface_read
 */
struct scene *gls_surface_end(struct gls_exec *x, struct gls_surface *surface, int is_shown);

/** 1 if a surface shows pixels of skipped frames; events are rendered to find out. */
int gls_surface_is_unknown(struct gls_exec *x, struct gls_surface *surface);

/**
 * Store the initial contents of a surface without events as a picture, if they are known.
 * @return 1; 0: a frame is in progress, or x->failed
 */
int gls_surface_settle(struct gls_exec *x, struct gls_surface *surface);

/** Give `to`, which is empty, the same initial contents as `from`. */
void gls_surface_share(struct gls_surface *to, const struct gls_surface *from);

/** Drop events and initial contents. */
void gls_surface_free(struct gls_surface *surface);
