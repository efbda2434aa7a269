/*
 * Conversion of client pixels to texels (GL 2.1 sec. 3.6.3 - 3.6.5): memory layout, formats and types, pixel transfer.
 *
 * Bytes that are not in the recording are read as 0.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct call;
struct gls_exec;
struct gls_pixel_store;
struct gls_state;
struct pixel_box;

/* Pixels passed to a command. */
struct gls_pixels {
	uint32_t format, type;                /* GL tokens */
	uint32_t width, height, depth;        /* depth: of a 3D image; 0: a 2D image, which ignores SKIP_IMAGES */
	const uint8_t *data;                  /* borrowed */
	size_t n;                             /* number of bytes available */
	const struct gls_pixel_store *store;  /* their layout; borrowed */
	int drawn; /* 1: by glDrawPixels: Mesa (22.3.6) neither shifts and offsets its indices nor scales and biases its
	              depths of type GL_FLOAT */
};

/**
 * Bytes from a pixel pointer to the end of the last pixel that GL reads; 0 if there are none (capture/format/sizes.h).
 */
size_t gls_pixel_bytes(const struct gls_pixel_store *store, const struct pixel_box *box);

/** The bytes of a pixel argument: in client memory, or in the bound unpack buffer. NULL: there are none. */
const uint8_t *gls_pixel_source(struct gls_state *st, const struct call *c, unsigned i, size_t *n);

/** Check whether these bytes are in a buffer that lacks pixels (gls_buffer_lacks). @return its `missing` */
uint32_t gls_pixel_missing(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned i);

/**
 * Convert client pixels to texels, through pixel transfer.
 * @param out  width * height * depth texels of the internal format; one float each if its base is DEPTH_COMPONENT
 * @return 0; -1: unsupported format and type (counted); -2: too few bytes (the available ones were read)
 */
int gls_unpack_pixels(struct gls_exec *x, const struct gls_state *st, const struct gls_pixels *p,
                      uint32_t internal_format, uint8_t *out);

/**
 * Convert pixels of format COLOR_INDEX or STENCIL_INDEX (sec. 3.6.5): shifted, offset, mapped.
 * @param out  receives RGBA bytes, or stencil values of 4 bytes
 * @return 0, or -1: not a type of indices
 */
int gls_unpack_indices(const struct gls_state *st, const struct gls_pixels *p, uint8_t *out);

/** The stencil values of pixels with format DEPTH_STENCIL, one byte each. */
void gls_unpack_stencil(const struct gls_pixels *p, uint8_t *out);

/** A bit of a bitmap (sec. 3.7): type BITMAP, whatever p->type is. */
int gls_unpack_bit(const struct gls_pixels *p, uint32_t x, uint32_t y);
