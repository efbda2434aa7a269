/* OES_compressed_paletted_texture, part of OpenGL ES 1: images of indices that follow their palette. */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct gls_palette {
	uint32_t internal_format, format, type; /* GL tokens for its entries */
	size_t entries, entry_bytes;
	unsigned index_bits;                    /* 4 or 8 */
};

/** Describe a compressed format's palette. @return 0: not a paletted format */
int gls_palette_of(uint32_t internal_format, struct gls_palette *out);

/**
 * Expand a level's texels to palette entries, row by row.
 * @param data   the palette, then the levels' indices, each level starting at a whole byte
 * @param n      size of data
 * @param first  number of texels in earlier levels, rounded up to whole bytes of indices
 * @param count  number of texels in this level
 * @param out    receives count * entry_bytes
 * @return 0, or -1: too few bytes
 */
int gls_palette_expand(const struct gls_palette *p, const uint8_t *data, size_t n, size_t first, size_t count,
                       uint8_t *out);
