/*
 * Pixels for the client (GL 2.1 sec. 4.3.2, "Final Conversion" and "Placement in Client Memory"): how they lie there,
 * and their numbers.
 *
 * Numbers are as Mesa (22.3.6) has them. Signed ones have 0 at 0, other than table 4.7 says; depths of fewer than 32
 * bits but for unsigned shorts are cut off.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/gl/texture/clientformat.h"

struct gls_pixel_store;

struct gls_packing {
	uint32_t format, type;                  /* GL tokens */
	const struct gls_client_format *colors; /* NULL: stencil indices */
	const struct gls_packed *packed;        /* NULL: each component has bytes of its own */
	int swap;
	size_t component, group;                /* bytes of a component, of a pixel */
	uint64_t row, image, start, end; /* bytes: from row to row, image to image; where the first pixel begins, the
	                                    last one ends */
};

/* A colour to be packed. */
struct gls_packed_color {
	float rgba[4];
	int bytes;    /* 1: they are bytes, which no transfer changed */
	int is_texel; /* 1: of a texture, whose luminance is its red */
};

/** @return 0: a format and type that are not done */
int gls_packing_find(uint32_t format, uint32_t type, struct gls_packing *p);

/** How an image of this size lies behind a place of a buffer. depth: 0: a 2D image, for which SKIP_IMAGES does not
 * count. @return 0: it does not fit */
int gls_packing_lay(struct gls_packing *p, const struct gls_pixel_store *store, const uint32_t size[3], uint64_t offset,
                    uint64_t bytes);

/** Where a pixel begins, after gls_packing_lay. */
static inline size_t gls_packing_at(const struct gls_packing *p, uint32_t x, uint32_t y, uint32_t z)
{
	return (size_t)(p->start + z * p->image + y * p->row + (uint64_t)x * p->group);
}

/** A pixel: its bytes at `to`. */
void gls_pack_color(const struct gls_packing *p, const struct gls_packed_color *color, uint8_t *to);
/** The same of a depth. steps: of so many bits, the same depth as it is stored; bits 0: only `depth` is known */
void gls_pack_depth(const struct gls_packing *p, float depth, uint32_t steps, uint32_t bits, uint8_t stencil,
                    uint8_t *to);
void gls_pack_stencil(const struct gls_packing *p, uint8_t stencil, uint8_t *to);
