/*
 * Surfaces: what is drawn to, and its pixels where they are needed.
 *
 * Nobody renders but the supplier (replay.h). A surface keeps the events that it saw, and what it held before them.
 */
#pragma once

#include "replay/build/frame.h"

/**
 * The pixels of a surface as all events so far leave them.
 * @param area  what is looked at: other pixels need not be right; NULL: all
 * @return borrowed, valid until the surface's next event; NULL: not to be had (counted, or x->feedback.rewind is set)
 */
const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface,
                                             const struct gls_area *area);

/**
 * Let the same events begin from another picture (takes the reference), and draw the next of several buffers.
 * @return 1; 0: what was there before does not show, and no program has another colour for another buffer
 */
int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture);

/**
 * End the surface's scene: what comes next begins from what it shows.
 * @param is_shown  whether it is handed out as a frame
 * @return a reference for the caller; NULL: as gls_surface_read
 */
struct scene *gls_surface_end(struct gls_exec *x, struct gls_surface *surface, int is_shown);

/** Whether events of a surface show what skipped frames drew; they are rendered to find out. */
int gls_surface_is_unknown(struct gls_exec *x, struct gls_surface *surface);

/**
 * Let a surface that has no events hold what it began with as a picture, if that is known.
 * @return 1; 0: a frame goes on, or x->failed
 */
int gls_surface_settle(struct gls_exec *x, struct gls_surface *surface);

/** Make `to`, which holds nothing, begin from what `from` begins from. */
void gls_surface_share(struct gls_surface *to, const struct gls_surface *from);

/** Forget events and what was there before them. */
void gls_surface_free(struct gls_surface *surface);
