/*
 * A picture's rows on their way into chunks of an OpenEXR file (exr_pack.h), packed by several threads. Its rows may
 * come in bands, from the top: what is packed needs no plane any more.
 */
#pragma once

#include "tracer/image/image.h"

#define PACK_ROWS 16u /* of a chunk; the last may have fewer */

/* One chunk as the file has it. */
struct pack_chunk {
	void *bytes; /* NULL: not packed yet */
	size_t n;
};

struct pack {
	const struct image_channel **sorted; /* [n_channels] by name, as in the file; borrowed from the image */
	size_t n_channels;
	struct pack_chunk *chunks; /* [n_chunks] */
	uint32_t n_chunks, n_packed; /* n_packed: from the top on */
	unsigned threads;
	struct exr_packer *tools; /* [threads] */
};

/**
 * @param img      with all its channels; borrowed
 * @param threads  that pack together, the caller's among them
 * @return 0 or ERR_SYSTEM (reported)
 */
int pack_create(const struct image *img, unsigned threads, struct pack **out);
void pack_destroy(struct pack **pack);

/**
 * Pack all whole chunks above a row that are not packed yet; at the picture's height all that are left.
 * @param img     the image of pack_create
 * @param planes  [n_channels] of each channel, in the image's order, rows from `first` on; NULL: the image's own planes
 * hold them
 * @return 0 or ERR_SYSTEM (reported)
 */
int pack_until(struct pack *pack, const struct image *img, const void *const *planes, uint32_t first, uint32_t end);
