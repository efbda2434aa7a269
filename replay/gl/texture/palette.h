/* OES_compressed_paletted_texture, a part of OpenGL ES 1: images of indices behind their palette. */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct gls_palette {
	uint32_t internal_format, format, type; /* of its entries: GL tokens */
	size_t entries, entry_bytes;
	unsigned index_bits;                    /* 4 or 8 */
};

/** What a compressed format's palette is. @return 0: it is another one */
int gls_palette_of(uint32_t internal_format, struct gls_palette *out);

/**
 * The entries that a level's texels are, row by row.
 * @param data   the palette, then the levels' indices, each from a whole byte on
 * @param n      bytes there
 * @param first  texels of the levels before this one, rounded up to whole bytes of indices
 * @param count  texels of this one
 * @param out    receives count * entry_bytes
 * @return 0, or -1: there are too few bytes
 */
int gls_palette_expand(const struct gls_palette *p, const uint8_t *data, size_t n, size_t first, size_t count,
                       uint8_t *out);
