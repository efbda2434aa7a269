/*
 * Rows of a picture as a chunk of an OpenEXR file with "ZIP" compression. A chunk's bytes, line by line and channel by
 * channel, are split into those at even and at odd places. Each byte becomes its difference from the one before plus
 * 128. All are deflated in zlib's wrapping (OpenEXR, "Technical Introduction"; OpenEXR File Layout). ISA-L deflates
 * four to eight times as fast as libdeflate's level 4 does, into some 10 % more bytes.
 */
#ifndef TRACER_IMAGE_EXR_PACK_H
#define TRACER_IMAGE_EXR_PACK_H

#include <stddef.h>
#include <stdint.h>

/* What a file holds of one channel. */
struct exr_plane {
	const uint16_t *halves; /* rows of so many pixels, or */
	const float *floats;    /* the same */
	int full_float;         /* 1: the file has floats, 0: it has halves */
};

struct exr_rows {
	const struct exr_plane *planes; /* in the file's order */
	size_t n_planes;
	uint32_t width, first, count;   /* rows first .. first + count - 1 */
};

/* One thread's tools. All zero at first. */
struct exr_packer {
	uint8_t *bytes;           /* room for a line; the chunk, split */
	size_t size;
	uint8_t *packed;          /* the chunk of the last call */
	size_t n_packed, packed_size;
	uint64_t constant;        /* hash of the values, where that chunk has one value in each channel; 0: it has not */
};

/**
 * Pack rows.
 * @return 0; packer->packed holds packer->n_packed bytes until the next call. ERR_SYSTEM: out of memory (reported)
 */
int exr_pack(struct exr_packer *packer, const struct exr_rows *rows);
void exr_packer_free(struct exr_packer *packer);

#endif
