/* Ends of frames. */
#pragma once

struct gls_exec;
struct scene;

/**
 * End a wanted frame. @return a reference to the scene of the swapped drawable; NULL: out of memory, or
 * x->feedback.rewind is set
 */
struct scene *gls_frame_finish(struct gls_exec *x);

/**
 * End a frame that was built only because later ones may show it. Its events stay with their surface: a hundred such
 * frames are one scene, rendered once if at all.
 */
void gls_frame_defer(struct gls_exec *x);

/** Call before a wanted frame: ends the scenes of deferred frames. */
void gls_frame_end_deferred(struct gls_exec *x);

/**
 * Call after a frame that was built: stores the drawables' pixels as pictures, for a snapshot
 * (replay/index/snapshot.h).
 * @return 1; 0: not all of them can be kept now
 */
int gls_frame_settle(struct gls_exec *x);

/** End a frame that was executed without being built: its pixels are unknown. */
void gls_frame_skip(struct gls_exec *x);
