/*
 * OpenEXR's "ZIP" compression by libdeflate, in place of OpenEXRCore's own step: the same chunks in less than half the
 * time, which is most of what a simple frame costs. A chunk's bytes are split into those at even and at odd places, each is
 * replaced by its difference from the one before plus 128, and all are deflated in zlib's wrapping (OpenEXR, "Technical
 * Introduction"; OpenEXR File Layout).
 */
#pragma once

#include <openexr.h>
#include <stddef.h>
#include <stdint.h>

struct libdeflate_compressor;
struct libdeflate_decompressor;

/* Lives as long as the pipeline that uses it. All zero at first. */
struct exr_zip {
	struct libdeflate_compressor *compressor;
	struct libdeflate_decompressor *decompressor;
	uint8_t *split, *packed; /* one chunk each: rearranged bytes, and what becomes of them */
	size_t split_size, packed_size;
};

/** Let an encoding pipeline, its routines chosen, compress with `zip`. */
void exr_zip_encode_with(exr_encode_pipeline_t *encode, struct exr_zip *zip);

/** Let a decoding pipeline of a ZIP or ZIPS part, its routines chosen, expand with `zip`. */
void exr_zip_decode_with(exr_decode_pipeline_t *decode, struct exr_zip *zip);

/** Call it after the pipeline is destroyed. */
void exr_zip_free(struct exr_zip *zip);
