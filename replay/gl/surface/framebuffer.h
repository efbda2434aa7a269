/*
 * Framebuffer objects (EXT_framebuffer_object; GL 3.0 sec. 4.4). Each is a surface; its events are rendered, and stored
 * in the attachments, only when something reads these.
 */
#pragma once

#include "replay/build/frame.h"
#include "replay/gl/surface/attachment.h"

struct gls_state;
struct gls_texture;

struct gls_framebuffer {
	struct gls_attachment attached[N_GLS_ATTACHMENTS];
	uint32_t draw_buffer, read_buffer; /* GL tokens, valid while it is not bound */
	uint32_t also_drawn;               /* as in struct gls_color_buffer, valid while it is not bound */
	uint32_t drawn_buffer;             /* draw buffer of the surface's events, */
	uint32_t drawn_too;                /* and further colours, 1 << number; each starts from its own contents */
	struct gls_surface surface;
	struct gls_picture *read; /* a reference: result of the last read */
};

/** The surface of the bound object; NULL: out of memory, or nothing is attached. */
struct gls_surface *gls_framebuffer_surface(struct gls_exec *x, struct gls_state *st);

/** The pixels of the bound read object, as gls_read_screen. */
const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st, const struct gls_area *area);

/** Call if a frame is not built: the attachments of the bound object, if any, are missing from now on. */
void gls_framebuffer_skip(struct gls_exec *x, struct gls_state *st);

/** Update a texture (NULL: none) with what was drawn to it, before it is read or changed. */
void gls_texture_update(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t);

/** Update all textures that a draw with these units reads. */
void gls_units_update(struct gls_exec *x, struct gls_state *st, const struct gls_texturing *texturing);

/* The draws that made a picture. */
struct gls_drawn {
	struct scene *scene;    /* a reference, or NULL: unknown */
	uint32_t width, height; /* size of the picture, if a checkpoint did not include its scene; else 0 */
};

/** The draws that made a texture's (NULL: none) present contents. */
struct gls_drawn gls_texture_drawn(const struct gls_texture *t);

/**
 * Update an object's only colour attachment, if it has 8 bits per channel and the context reads it.
 * @return its draws
 */
struct gls_drawn gls_framebuffer_drawn(struct gls_exec *x, const struct gls_state *st, uint32_t name);

/** 1 if some object has events that are not stored in its attachments yet. */
int gls_framebuffers_wait(const struct gls_share *share);

void gls_framebuffer_free(struct gls_framebuffer *fb);
void gls_renderbuffer_free(struct gls_renderbuffer *r);
