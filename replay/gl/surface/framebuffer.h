/*
 * Framebuffer objects (EXT_framebuffer_object; GL 3.0 sec. 4.4). What is drawn to one is a surface of its own; its
 * events are rendered, and written to what is attached, only when somebody looks at that.
 */
#pragma once

#include "replay/build/frame.h"
#include "replay/gl/surface/attachment.h"

struct gls_state;
struct gls_texture;

struct gls_framebuffer {
	struct gls_attachment attached[N_GLS_ATTACHMENTS];
	uint32_t draw_buffer, read_buffer; /* GL tokens, while it is not bound */
	uint32_t also_drawn;               /* as in struct gls_color_buffer, while it is not bound */
	uint32_t drawn_buffer;             /* what the surface's events draw to, */
	uint32_t drawn_too;                /* and other colours, 1 << number: each begins from what it held itself */
	struct gls_surface surface;
	struct gls_picture *read; /* a reference: what was read last */
};

/** What the bound object draws to; NULL: out of memory, or nothing is attached. */
struct gls_surface *gls_framebuffer_surface(struct gls_exec *x, struct gls_state *st);

/** The pixels of the bound read object: as gls_read_screen. */
const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st, const struct gls_area *area);

/** A frame is not built: what is attached to the bound object, if one is, is missing from now on. */
void gls_framebuffer_skip(struct gls_exec *x, struct gls_state *st);

/** Bring a texture (NULL: none) up to date with what was drawn to it, before it is looked at or changed. */
void gls_texture_update(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t);

/** The same of all textures that a draw with these units looks at. */
void gls_units_update(struct gls_exec *x, struct gls_state *st, const struct gls_texturing *texturing);

/* All draws of a picture. */
struct gls_drawn {
	struct scene *scene;    /* a reference, or NULL: not known */
	uint32_t width, height; /* where a checkpoint did not hold that scene: the picture's; else 0 */
};

/** All draws of a texture (NULL: none), as it is now. */
struct gls_drawn gls_texture_drawn(const struct gls_texture *t);

/**
 * Bring an object's only colours, of 8 bits each, up to date, if the context reads these.
 * @return its draws
 */
struct gls_drawn gls_framebuffer_drawn(struct gls_exec *x, const struct gls_state *st, uint32_t name);

/** Whether events of some object are not in its attachments yet. */
int gls_framebuffers_wait(const struct gls_share *share);

void gls_framebuffer_free(struct gls_framebuffer *fb);
void gls_renderbuffer_free(struct gls_renderbuffer *r);
