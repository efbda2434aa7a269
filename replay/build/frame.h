/* A surface and its events: what is drawn and cleared becomes a scene. Nothing happens unless scenes are built
 * (x->want). */
#pragma once

#include <stdint.h>

#include "gl_tokens.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

struct gls_mesh;
struct gls_texture_image;

/* Something that is drawn to. All zero: black, and nothing has happened. */
struct gls_surface {
	uint32_t width, height, depth_bits, stencil_bits, alpha_bits;
	uint32_t samples, samples_from_below, floats; /* as in struct scene */
	uint32_t srgb;               /* 1: it can hold sRGB colours */
	struct gls_frame *frame;     /* owned: events; NULL: none */
	struct gls_picture *picture; /* a reference: what it held before the events, */
	struct scene *before;        /* or a reference to the scene that shows it; at most one of the two is there */
	int deferred;                /* 1: some events belong to earlier frames that nobody wanted */
	int is_front;                /* 1: a front buffer beside a back buffer */
	uint32_t lacks;              /* as gls_picture's, of `before` */
	int skipped;                 /* 1: neither is there, because skipped frames drew to it */
};

/* What an event changes. */
struct gls_target {
	struct gls_surface *surface;
	int colored; /* 0: colours go to another surface, which shares this one's depth and stencil */
};

/* What is read of a surface. */
struct gls_area {
	int32_t rect[4];  /* x, y, width, height */
	uint32_t buffers; /* bits as in scene_clear */
};

/* What is drawn. */
struct gls_event {
	const struct gls_attribs *attribs; /* to draw with: the state's, or changed ones */
	struct gls_mesh *mesh;     /* no reference is taken (the scene takes its own) */
	const float (*values)[4];  /* attributes that the mesh does not give */
	uint32_t command;
	uint64_t call_number;
	const struct scene_rectangle *rectangle; /* of pixels, at the mesh's only point; its texture is filled in. NULL:
	                                            none */
	struct gls_texture_image *image;         /* its pixels */
	int in_window; /* 1: positions are window coordinates and texture coordinates final: no matrix counts */
};

/**
 * 1 if draws and clears reach a surface when scenes are built: not so in selection and feedback (sec. 5.2, 5.3), nor
 * where a condition does not hold.
 */
static inline int gls_renders(const struct gls_state *st)
{
	return st->render_mode == GL_RENDER && !st->rasterizer_discard && !st->left_out;
}
/** 1 if they reach it now. */
static inline int gls_is_drawn(const struct gls_exec *x, const struct gls_state *st)
{
	return x->want && gls_renders(st);
}

/**
 * Draw on a surface. st->dirty says which state has changed since the surface saw it last.
 * @return 1; 0: out of memory (reported)
 */
int gls_frame_add(struct gls_exec *x, const struct gls_target *target, struct gls_state *st, const struct gls_event *e);
/** An event passed a surface by: the surface has not seen the event's state. */
void gls_frame_pass(struct gls_surface *surface);
/** Clear a surface; buffers: as in scene_clear. */
void gls_frame_clear(struct gls_exec *x, const struct gls_target *target, const struct gls_state *st, uint32_t buffers);
/** The scene of all events so far, valid until the next event; begun if there is none. Borrowed; NULL: out of
 * memory. */
struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface);
/** Take the scene out of the surface, which has no events then. @return a reference for the caller */
struct scene *gls_frame_take(struct gls_exec *x, struct gls_surface *surface);
/**
 * Let other events come in place of a surface's last one, which showed what these draw, in a rectangle of their
 * window's size. Depth and stencil values are afterwards what they were there. In shown.c.
 * @param drawn  borrowed
 * @param rect   x, y, width, height on the surface
 * @param depth  that what showed them left there; NULL: none
 * @return 1; 0: out of memory (reported)
 */
int gls_frame_put(struct gls_exec *x, struct gls_surface *surface, const struct scene *drawn, const int32_t rect[4],
                  const float *depth);
/** Forget all events. */
void gls_frame_drop(struct gls_surface *surface);
/** Buffers, bits as in scene_clear, that some draw looked at where clears had not set them. The surface must have a
 * frame. */
uint32_t gls_frame_looked(const struct gls_surface *surface);
/** Nothing from before the events shows any more. */
void gls_frame_all_known(struct gls_surface *surface);
/** Give the scene another serial number: what was rendered of it is not looked for. */
void gls_frame_renew(struct gls_surface *surface);
/** How many events there are. */
uint64_t gls_frame_events(const struct gls_surface *surface);
/** 1 where its events alone tell the pixels of an area (NULL: of everything). The surface must have a frame. */
int gls_frame_knows(const struct gls_surface *surface, const struct gls_area *area);
/** The picture of all events that was kept and holds in an area (NULL: everywhere), or NULL. Borrowed. The surface must
 * have a frame. */
const struct gls_picture *gls_frame_snapshot(const struct gls_surface *surface, const struct gls_area *area);
/** Keep one. @param p  a reference, taken; NULL: none  @param in_part  1: it holds only in areas that
 * gls_frame_knows */
void gls_frame_keep_snapshot(struct gls_surface *surface, struct gls_picture *p, int in_part);
/** One more reference. */
struct scene *gls_scene_reference(struct scene *scene);
