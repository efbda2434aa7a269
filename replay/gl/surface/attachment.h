/* Attachments of framebuffer objects, and their pixels. */
#pragma once

#include <stdint.h>

#include "replay/machine/picture.h"

struct gls_exec;
struct gls_share;
struct gls_area;
struct gls_surface;

/* The object at an attachment point: a renderbuffer, or an image of a texture; neither: nothing. */
struct gls_attachment {
	uint32_t texture, renderbuffer; /* names */
	uint32_t face, level, layer;    /* within the texture */
};
enum { GLS_ATTACHMENT_DEPTH = 8, GLS_ATTACHMENT_STENCIL, N_GLS_ATTACHMENTS }; /* below: colour attachments */

struct gls_renderbuffer {
	uint32_t internal_format, width, height;
	uint32_t missing;            /* as in a texture's level */
	uint32_t samples;            /* per pixel; 0: one */
	struct gls_picture *content; /* a reference; NULL: all 0 */
};

/** Number of the colour attachment that a GL token refers to, -1: none. */
int gls_attachment_color(uint32_t buffer);

/** 1 if both refer to the same texture or renderbuffer. */
int gls_attachment_is_same(const struct gls_attachment *a, const struct gls_attachment *b);

/** 1 if an attachment's red, green and blue have 8 bits each, like a window's. */
int gls_attachment_has_8_bits(const struct gls_share *share, const struct gls_attachment *a);

/**
 * Set a surface's size and bits from depth, stencil and these colours (1 << number) together.
 * @return 0: nothing is attached there
 */
int gls_attachments_describe(const struct gls_share *share, const struct gls_attachment attached[N_GLS_ATTACHMENTS],
                             uint32_t colors, struct gls_surface *s);

/**
 * Load depth, stencil and a colour (-1: none) as the contents of a surface.
 * @param area  the part that is read; NULL: all
 * @return a reference; NULL: missing, or out of memory
 */
struct gls_picture *gls_attachments_load(struct gls_exec *x, const struct gls_share *share,
                                         const struct gls_attachment attached[N_GLS_ATTACHMENTS], int color,
                                         const struct gls_surface *s, const struct gls_area *area);

/** Store a picture in attachments (1 << number). p: NULL in a frame that is not built: they are missing from now on */
void gls_attachments_store(struct gls_exec *x, const struct gls_share *share,
                           const struct gls_attachment attached[N_GLS_ATTACHMENTS], uint32_t which,
                           const struct scene_picture *p);
