/*
 * Compression of plain images to S3TC (EXT_texture_compression_s3tc), block by block, to exactly the bytes that Mesa
 * (22.3.6) produces: its choice of a block's colours is its own, and so are the last bits of the result.
 */
#pragma once

#include <stdint.h>

/* A block's texels; those beyond width and height are ignored. */
struct s3tc_texels {
	unsigned width, height; /* 1 .. 4 */
	uint8_t rgba[4][4][4];  /* [y][x] */
};

/*
 * The data of a block in addition to 8 bytes of colours (NONE: not S3TC): nothing, transparent texels among the
 * colours, 4 bits of alpha per texel, or levels of alpha.
 */
enum s3tc_kind { S3TC_NONE, S3TC_RGB, S3TC_RGBA, S3TC_BITS, S3TC_LEVELS };

/** @param block  8 bytes, or 16 with alpha before the colours */
void s3tc_encode(enum s3tc_kind kind, const struct s3tc_texels *t, uint8_t *block);
