/*
 * Pixels returned to the client (GL 2.1 sec. 4.3.2, "Final Conversion" and "Placement in Client Memory"): their layout
 * and values.
 *
 * Values are Mesa's (22.3.6). Signed ones map 0 to 0, contrary to table 4.7; depths with fewer than 32 bits are
 * truncated, except for unsigned shorts.
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
	size_t component, group;                /* size in bytes of a component, of a pixel */
	uint64_t row, image, start, end; /* in bytes: from row to row, from image to image; start of the first pixel,
	                                    end of the last one */
};

/* A colour to pack. */
struct gls_packed_color {
	float rgba[4];
	int bytes;    /* 1: from bytes that pixel transfer did not change */
	int is_texel; /* 1: from a texture, whose luminance is in red */
};

/** @return 0: unsupported format and type */
int gls_packing_find(uint32_t format, uint32_t type, struct gls_packing *p);

/**
 * Lay out an image of this size in a buffer, from an offset on. depth: 0: a 2D image, which ignores SKIP_IMAGES.
 * @return 0: it does not fit
 */
int gls_packing_lay(struct gls_packing *p, const struct gls_pixel_store *store, const uint32_t size[3], uint64_t offset,
                    uint64_t bytes);

/** Offset of a pixel, after gls_packing_lay. */
static inline size_t gls_packing_at(const struct gls_packing *p, uint32_t x, uint32_t y, uint32_t z)
{
	return (size_t)(p->start + z * p->image + y * p->row + (uint64_t)x * p->group);
}

/** Pack a colour into the bytes of a pixel. */
void gls_pack_color(const struct gls_packing *p, const struct gls_packed_color *color, uint8_t *to);
/**
 * Pack a depth into the bytes of a pixel. steps: the stored depth, with this number of bits; bits 0: only `depth` is
 * known
 */
void gls_pack_depth(const struct gls_packing *p, float depth, uint32_t steps, uint32_t bits, uint8_t stencil,
                    uint8_t *to);
void gls_pack_stencil(const struct gls_packing *p, uint8_t stencil, uint8_t *to);
