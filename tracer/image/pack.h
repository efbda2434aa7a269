/*
 * Packs the rows of a picture into chunks of an OpenEXR file (exr_pack.h), on several threads. Rows may arrive in
 * bands, from the top. Once a row is packed, its pixels may be freed.
 */
#pragma once

#include "tracer/image/image.h"

#define PACK_ROWS 16u /* rows in a chunk; the last may have fewer */

/* One chunk in the file's format. */
struct pack_chunk {
	void *bytes; /* NULL: not packed yet */
	size_t n;
};

struct pack {
	const struct image_channel **sorted; /* [n_channels] by name, as in the file; borrowed from the image */
	size_t n_channels;
	struct pack_chunk *chunks; /* [n_chunks] */
	uint32_t n_chunks, n_packed; /* n_packed: number packed so far, from the top */
	unsigned threads;
	struct exr_packer *tools; /* [threads] */
};

/**
 * @param img      image with all its channels; borrowed
 * @param threads  number of threads that pack, including the caller
 * @return 0 or ERR_SYSTEM (reported)
 */
int pack_create(const struct image *img, unsigned threads, struct pack **out);
void pack_destroy(struct pack **pack);

/**
 * Pack all complete chunks above row `end` that are not packed yet. If `end` is the picture's height, pack all the
 * rest.
 * @param img     the image of pack_create
 * @param planes  [n_channels] rows from `first` on of each channel, in the image's order; NULL: they are in the image's
 *                planes
 * @return 0 or ERR_SYSTEM (reported)
 */
int pack_until(struct pack *pack, const struct image *img, const void *const *planes, uint32_t first, uint32_t end);
