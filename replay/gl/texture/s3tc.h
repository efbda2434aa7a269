/*
 * Compression of plain images to S3TC (EXT_texture_compression_s3tc), block by block, to the bytes that Mesa (22.3.6)
 * makes of them: how it looks for a block's colours is its own, and so are the last bits of what is left.
 */
#pragma once

#include <stdint.h>

/* A block's texels, of which those beyond width and height do not count. */
struct s3tc_texels {
	unsigned width, height; /* 1 .. 4 */
	uint8_t rgba[4][4][4];  /* [y][x] */
};

/*
 * What a block holds beside 8 bytes of colours (NONE: it is none of S3TC): nothing, transparent texels among the
 * colours, 4 bits of alpha a texel, levels of alpha.
 */
enum s3tc_kind { S3TC_NONE, S3TC_RGB, S3TC_RGBA, S3TC_BITS, S3TC_LEVELS };

/** @param block  8 bytes, or 16 where alpha stands before the colours */
void s3tc_encode(enum s3tc_kind kind, const struct s3tc_texels *t, uint8_t *block);
