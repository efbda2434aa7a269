/*
 * Decompression of OpenEXR's "ZIP" chunks with libdeflate. It replaces OpenEXRCore's own step, which takes more than
 * twice as long. exr_pack.h describes the contents of such a chunk.
 */
#pragma once

#include <openexr.h>
#include <stddef.h>
#include <stdint.h>

struct libdeflate_decompressor;

/* Must outlive the pipeline that uses it. Initially all zero. */
struct exr_zip {
	struct libdeflate_decompressor *decompressor;
	uint8_t *split; /* a chunk's rearranged bytes */
	size_t split_size;
};

/** Make a decoding pipeline of a ZIP or ZIPS part decompress with `zip`. Call after the pipeline's routines have been
 * chosen. */
void exr_zip_decode_with(exr_decode_pipeline_t *decode, struct exr_zip *zip);

/** Call after the pipeline has been destroyed. */
void exr_zip_free(struct exr_zip *zip);
