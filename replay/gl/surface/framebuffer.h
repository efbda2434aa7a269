/* Framebuffer objects: what is attached holds the truth, and is brought up to date when it is looked at. */
#ifndef REPLAY_GL_SURFACE_FRAMEBUFFER_H
#define REPLAY_GL_SURFACE_FRAMEBUFFER_H

#include <stdint.h>

#include "replay/machine/commands.h"
#include "replay/gl/surface/feedback.h"

struct gls_texture;

gls_handler gls_glBindFramebuffer, gls_glBindRenderbuffer;

/* What an attachment point of a framebuffer object names: a renderbuffer, or an image of a texture; neither: nothing. */
struct gls_attachment {
	uint32_t texture, renderbuffer; /* names */
	uint32_t face, level, layer;    /* of the texture */
};
enum { GLS_ATTACHMENT_DEPTH = 8, GLS_ATTACHMENT_STENCIL, N_GLS_ATTACHMENTS }; /* below: colours */

struct gls_renderbuffer {
	uint32_t internal_format, width, height;
	uint32_t missing;            /* as of a texture's level */
	uint32_t samples;            /* of a pixel; 0: one */
	struct gls_picture *content; /* a reference; NULL: black, far and 0 */
};

/* A framebuffer object. */
struct gls_framebuffer {
	struct gls_attachment attached[N_GLS_ATTACHMENTS];
	uint32_t draw_buffer, read_buffer; /* GL tokens, while it is not bound */
	uint32_t also_drawn;               /* as in struct gls_color, while it is not bound */
	uint32_t drawn_buffer;             /* what the surface's events draw to, */
	uint32_t drawn_too;                /* and other colours, 1 << number: each begins from what it held itself */
	struct gls_surface surface;
	struct gls_picture *read; /* a reference: what was read last */
};

/** What the bound object draws to; NULL: out of memory, or nothing is attached. */
struct gls_surface *gls_framebuffer_surface(struct gls_exec *x, struct gls_state *st);
/** As gls_read_screen, of the bound read object. */
const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st);
/** The bound object, if it is one, may have been drawn to in a frame that is not built. */
void gls_framebuffer_touch(struct gls_exec *x, struct gls_state *st);
/** Bring textures up to date that are drawn to: one that is looked at or changed; all that a draw looks at. */
void gls_texture_settle(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t);
void gls_units_settle(struct gls_exec *x, struct gls_state *st);
/** A texture is deleted. */
void gls_texture_detach(struct gls_exec *x, struct gls_state *st, uint32_t name);
void gls_framebuffer_free(struct gls_framebuffer *fb);
void gls_renderbuffer_free(struct gls_renderbuffer *r);

#endif
