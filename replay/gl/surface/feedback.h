/* Surfaces: what is drawn to, and the pixels of it that are needed. */
#ifndef REPLAY_GL_SURFACE_FEEDBACK_H
#define REPLAY_GL_SURFACE_FEEDBACK_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;
struct gls_frame;
struct gls_state;

/* A picture that several may hold on to; freed with the last reference, in any thread. */
struct gls_picture {
	struct scene_picture picture; /* first */
	atomic_uint refs;
};

/* Something that is drawn to: what it held, and what happened to it since. All zero: black, and nothing happened. */
struct gls_surface {
	uint32_t width, height, depth_bits, stencil_bits, alpha_bits;
	uint32_t samples, samples_from_below, floats; /* as in struct scene */
	struct gls_frame *frame;     /* owned: events; NULL: none */
	struct gls_picture *picture; /* a reference: what it held before them, */
	struct scene *before;        /* or a reference to the scene that makes it so; at most one of the two is there */
	int carried;                 /* 1: some of the events are of earlier frames, which nobody wanted */
	int is_front;                /* 1: a front buffer beside a back buffer */
	int skipped;                 /* 1: neither, because it was drawn to in frames that were skipped */
};

/** What the context draws to; NULL: out of memory, or an incomplete framebuffer object. */
struct gls_surface *gls_surface_of(struct gls_exec *x, struct gls_state *st);
/**
 * The pixels of a surface as all events so far leave them.
 * @return borrowed, valid until the surface's next event; NULL: not to be had (counted, or x->rewind is set)
 */
const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface);
/** Let the same events begin from another picture (takes the reference). @return 1; 0: what it was before does not show */
int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture);
/** The same of what the context reads from (ReadBuffer, read framebuffer, read drawable). */
const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st);
/** Make `to`, which holds nothing, begin from what `from` begins from. */
void gls_surface_share(struct gls_surface *to, const struct gls_surface *from);
/** The frame of the drawable that was swapped: its scene, a reference for the caller; NULL: out of memory or x->rewind. */
struct scene *gls_frame_finish(struct gls_exec *x);
/**
 * A frame ended that was built only for what later ones show of it: its events stay, so that a hundred such frames are one
 * scene, rendered once if at all. The second call is made before a frame that is wanted.
 */
void gls_frame_carry(struct gls_exec *x);
void gls_frame_stop_carrying(struct gls_exec *x);
/** A frame was executed without being built: what it drew is not known. */
void gls_frame_skip(struct gls_exec *x);
void gls_surface_free(struct gls_surface *surface);
/** A black one, far and 0; floats: its colours are there as floats, too. @return a reference; NULL: out of memory (reported) */
struct gls_picture *gls_picture_make(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t depth_bits,
                                     uint32_t alpha_bits, uint32_t samples, uint32_t floats);
/** The colour of a place in a picture. */
void gls_picture_color(const struct scene_picture *p, size_t place, float out[4]);
/** Kind of pixels that colours for what is drawn to should come as, so that none is clamped that need not be. */
uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st);
void gls_picture_release(struct gls_picture *picture);

#endif
