/*
 * Pixels of the client as texels (GL 2.1 sec. 3.6.3 - 3.6.5): how they lie in memory, their formats and types, pixel
 * transfer.
 *
 * Bytes that the recording does not hold are read as 0.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct call;
struct gls_exec;
struct gls_pixel_store;
struct gls_state;
struct pixel_box;

/* Pixels as a command gives them. */
struct gls_pixels {
	uint32_t format, type;                /* GL tokens */
	uint32_t width, height, depth;        /* depth: of a 3D image; 0: a 2D image, for which SKIP_IMAGES does not count */
	const uint8_t *data;                  /* borrowed */
	size_t n;                             /* bytes there are */
	const struct gls_pixel_store *store;  /* how they lie there; borrowed */
	int drawn; /* by glDrawPixels: Mesa (22.3.6) neither shifts and offsets its indices nor scales and biases its
	              depths of GL_FLOAT */
};

/** Bytes from a pixel pointer to the end of the last pixel that GL reads; 0 where there are none
 * (capture/format/sizes.h). */
size_t gls_pixel_bytes(const struct gls_pixel_store *store, const struct pixel_box *box);

/** The bytes of a pixel argument: client memory, or a place in the bound unpack buffer. NULL: there are none. */
const uint8_t *gls_pixel_source(struct gls_state *st, const struct call *c, unsigned i, size_t *n);

/** Whether those bytes are in a buffer that lacks pixels read into it (gls_buffer_lacks). @return its `missing` */
uint32_t gls_pixel_missing(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned i);

/**
 * Client pixels to texels, through pixel transfer.
 *
 * @param out  width * height * depth texels of the internal format; one float each where its base is DEPTH_COMPONENT
 * @return 0; -1: this format and type are not done (counted); -2: too few bytes (those that are there were read)
 */
int gls_unpack_pixels(struct gls_exec *x, const struct gls_state *st, const struct gls_pixels *p,
                      uint32_t internal_format, uint8_t *out);

/**
 * Pixels of COLOR_INDEX or STENCIL_INDEX (sec. 3.6.5): shifted, offset, through the maps.
 *
 * @param out  receives RGBA bytes, or stencil values of 4 bytes
 * @return 0, or -1: no type of indices
 */
int gls_unpack_indices(const struct gls_state *st, const struct gls_pixels *p, uint8_t *out);

/** The stencil values of pixels of the format DEPTH_STENCIL, a byte each. */
void gls_unpack_stencil(const struct gls_pixels *p, uint8_t *out);

/** A bit of a bitmap (sec. 3.7): type BITMAP, whatever p->type says. */
int gls_unpack_bit(const struct gls_pixels *p, uint32_t x, uint32_t y);
