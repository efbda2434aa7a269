/* What is attached to framebuffer objects, and its pixels. */
#pragma once

#include <stdint.h>

#include "replay/machine/picture.h"

struct gls_exec;
struct gls_share;
struct gls_area;
struct gls_surface;

/* What an attachment point names: a renderbuffer, or an image of a texture; neither: nothing. */
struct gls_attachment {
	uint32_t texture, renderbuffer; /* names */
	uint32_t face, level, layer;    /* of the texture */
};
enum { GLS_ATTACHMENT_DEPTH = 8, GLS_ATTACHMENT_STENCIL, N_GLS_ATTACHMENTS }; /* below: colours */

struct gls_renderbuffer {
	uint32_t internal_format, width, height;
	uint32_t missing;            /* as of a texture's level */
	uint32_t samples;            /* of a pixel; 0: one */
	struct gls_picture *content; /* a reference; NULL: all 0 */
};

/** Number of the colour that a GL token names, -1: none. */
int gls_attachment_color(uint32_t buffer);

/** 1 where both name the same texture or renderbuffer. */
int gls_attachment_is_same(const struct gls_attachment *a, const struct gls_attachment *b);

/** 1 where an attachment's colours are red, green and blue of 8 bits each, as a window's are. */
int gls_attachment_has_8_bits(const struct gls_share *share, const struct gls_attachment *a);

/**
 * Give a surface the size and bits that depth, stencil and these colours (1 << number) have together.
 * @return 0: nothing is attached there
 */
int gls_attachments_describe(const struct gls_share *share, const struct gls_attachment attached[N_GLS_ATTACHMENTS],
                             uint32_t colors, struct gls_surface *s);

/**
 * What depth, stencil and a colour (-1: none) hold, in the form of a surface.
 * @param area  what of it is looked at; NULL: all
 * @return a reference; NULL: missing, or out of memory
 */
struct gls_picture *gls_attachments_load(struct gls_exec *x, const struct gls_share *share,
                                         const struct gls_attachment attached[N_GLS_ATTACHMENTS], int color,
                                         const struct gls_surface *s, const struct gls_area *area);

/** Attachments (1 << number) become what was drawn to them. p: NULL in a frame that is not built: they are missing from
 * now on */
void gls_attachments_store(struct gls_exec *x, const struct gls_share *share,
                           const struct gls_attachment attached[N_GLS_ATTACHMENTS], uint32_t which,
                           const struct scene_picture *p);
