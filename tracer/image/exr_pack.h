/*
 * Packs rows of a picture as a chunk of an OpenEXR file with "ZIP" compression. The bytes of a chunk, line by line and
 * channel by channel, are split into those at even and those at odd offsets. Each byte is replaced by its difference
 * from the previous one plus 128. The result is deflated in zlib format (OpenEXR, "Technical Introduction"; OpenEXR
 * File Layout). ISA-L deflates four to eight times as fast as libdeflate's level 4, and gives some 10 % more bytes.
 */
#ifndef TRACER_IMAGE_EXR_PACK_H
#define TRACER_IMAGE_EXR_PACK_H

#include <stddef.h>
#include <stdint.h>

/* One channel of a file. */
struct exr_plane {
	const uint16_t *halves; /* rows as half floats, or NULL */
	const float *floats;    /* rows as floats, or NULL */
	int full_float;         /* 1: the file stores floats; 0: halves */
};

struct exr_rows {
	const struct exr_plane *planes; /* in the file's order */
	size_t n_planes;
	uint32_t width, first, count;   /* rows first .. first + count - 1 */
};

/* Working memory of one thread. Initially all zero. */
struct exr_packer {
	uint8_t *bytes;           /* room for a line, then the split chunk */
	size_t size;
	uint8_t *packed;          /* the packed chunk of the last call */
	size_t n_packed, packed_size;
	uint64_t constant;        /* if all pixels of that chunk are equal, a hash of their values; else 0 */
};

/**
 * Pack rows.
 * @return 0: packer->packed holds packer->n_packed bytes until the next call. ERR_SYSTEM: out of memory (reported)
 */
int exr_pack(struct exr_packer *packer, const struct exr_rows *rows);
void exr_packer_free(struct exr_packer *packer);

#endif
