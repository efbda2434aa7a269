/* Ends of frames. */
#pragma once

struct gls_exec;
struct scene;

/** A wanted frame ended: the scene of the drawable that was swapped. @return a reference; NULL: out of memory, or
 * x->feedback.rewind is set */
struct scene *gls_frame_finish(struct gls_exec *x);

/**
 * A frame ended that was built only because later ones may show it. Its events stay with their surface: a hundred such
 * frames are one scene, rendered once if at all.
 */
void gls_frame_defer(struct gls_exec *x);

/** Before a wanted frame: end the scenes of deferred frames. */
void gls_frame_end_deferred(struct gls_exec *x);

/**
 * After a frame that was built: let drawables hold their pixels as pictures, so that a snapshot can keep them
 * (replay/index/snapshot.h).
 * @return 1; 0: it cannot keep all of them now
 */
int gls_frame_settle(struct gls_exec *x);

/** A frame was executed without being built: what it drew is not known. */
void gls_frame_skip(struct gls_exec *x);
