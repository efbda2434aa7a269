/* A surface and its events: draws and clears become a scene. Nothing happens unless scenes are built (x->want). */
#pragma once

#include <stdint.h>

#include "gl_tokens.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

struct gls_mesh;
struct gls_texture_image;

/* A target of draws. All zero: black, no events yet. */
struct gls_surface {
	uint32_t width, height, depth_bits, stencil_bits, alpha_bits;
	uint32_t samples, samples_from_below, floats; /* as in struct scene */
	uint32_t srgb;               /* 1: can hold sRGB colours */
	struct gls_frame *frame;     /* owned: events; NULL: none */
	struct gls_picture *picture; /* a reference: contents before the events, */
	struct scene *before;        /* or a reference to the scene that renders them; at most one of the two is set */
	int deferred;                /* 1: some events belong to earlier frames, which were not wanted */
	int is_front;                /* 1: a front buffer beside a back buffer */
	uint32_t lacks;              /* as in gls_picture, for `before` */
	int skipped;                 /* 1: neither is set, because skipped frames drew to the surface */
};

/* The target of an event. */
struct gls_target {
	struct gls_surface *surface;
	int colored; /* 0: colours go to another surface, which shares the depth and stencil buffers of this one */
};

/* A part of a surface that is read. */
struct gls_area {
	int32_t rect[4];  /* x, y, width, height */
	uint32_t buffers; /* bits as in scene_clear */
};

/* A draw. */
struct gls_event {
	const struct gls_attribs *attribs; /* attributes to draw with: the state's, or modified ones */
	struct gls_mesh *mesh;     /* no reference is taken (the scene takes its own) */
	const float (*values)[4];  /* values of attributes that the mesh lacks */
	uint32_t given;            /* attributes that each vertex was given: by arrays, or between Begin and End; as
	                              scene_mesh.attributes */
	uint32_t command;
	uint64_t call_number;
	const struct scene_rectangle *rectangle; /* at the mesh's only point; its texture is filled in. NULL: not a
	                                            rectangle of pixels */
	struct gls_texture_image *image;         /* its pixels */
	int in_window; /* 1: positions are window coordinates, and texture coordinates are final: no matrix applies */
};

/**
 * 1 if draws and clears reach a surface when scenes are built: not in selection or feedback mode (sec. 5.2, 5.3), nor
 * if conditional rendering discards them.
 */
static inline int gls_renders(const struct gls_state *st)
{
	return st->render_mode == GL_RENDER && !st->rasterizer_discard && !st->left_out;
}
/** 1 if draws and clears reach a surface now. */
static inline int gls_is_drawn(const struct gls_exec *x, const struct gls_state *st)
{
	return x->want && gls_renders(st);
}

/**
 * Draw on a surface. st->dirty says which state has changed since the surface last read it.
 * @return 1; 0: out of memory (reported)
 */
int gls_frame_add(struct gls_exec *x, const struct gls_target *target, struct gls_state *st, const struct gls_event *e);
/** An event was not drawn on a surface, so the surface has not read its state. */
void gls_frame_pass(struct gls_surface *surface);
/** Clear a surface; buffers: as in scene_clear. */
void gls_frame_clear(struct gls_exec *x, const struct gls_target *target, const struct gls_state *st, uint32_t buffers);
/** The scene of all events so far, valid until the next event; begun if there is none. Borrowed; NULL: out of
 * memory. */
struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface);
/** Take the scene out of the surface, which then has no events. @return a reference for the caller */
struct scene *gls_frame_take(struct gls_exec *x, struct gls_surface *surface);
/**
 * Replace a surface's last event, which showed a picture, by the events that drew that picture, within a rectangle of
 * their window's size. Depth and stencil values are the same afterwards. In shown.c.
 * @param drawn  the scene that drew the picture; borrowed
 * @param rect   x, y, width, height on the surface
 * @param depth  the depths that showing the picture left there; NULL: none
 * @return 1; 0: out of memory (reported)
 */
int gls_frame_put(struct gls_exec *x, struct gls_surface *surface, const struct scene *drawn, const int32_t rect[4],
                  const float *depth);
/** Drop all events. */
void gls_frame_drop(struct gls_surface *surface);
/** Buffers that some draw read before clears had set them; bits as in scene_clear. The surface must have a frame. */
uint32_t gls_frame_looked(const struct gls_surface *surface);
/** Mark all earlier contents as no longer visible. */
void gls_frame_all_known(struct gls_surface *surface);
/** Give the scene a new serial number, so that earlier renderings of it are not reused. */
void gls_frame_renew(struct gls_surface *surface);
/** Number of events. */
uint64_t gls_frame_events(const struct gls_surface *surface);
/**
 * 1 if the surface's events alone determine the pixels of an area (NULL: of everything). The surface must have a frame.
 */
int gls_frame_knows(const struct gls_surface *surface, const struct gls_area *area);
/**
 * The picture kept of all events, if there is one and it is valid in an area (NULL: everywhere); otherwise NULL.
 * Borrowed. The surface must have a frame.
 */
const struct gls_picture *gls_frame_snapshot(const struct gls_surface *surface, const struct gls_area *area);
/**
 * Keep a picture of all events. @param p  a reference, taken; NULL: none  @param in_part  1: valid only in areas that
 * gls_frame_knows accepts
 */
void gls_frame_keep_snapshot(struct gls_surface *surface, struct gls_picture *p, int in_part);
/** Add a reference. */
struct scene *gls_scene_reference(struct scene *scene);
