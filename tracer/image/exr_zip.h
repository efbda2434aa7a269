/*
 * Expanding OpenEXR's "ZIP" chunks by libdeflate, in place of OpenEXRCore's own step, which takes more than twice as
 * long. exr_pack.h tells what such a chunk holds.
 */
#pragma once

#include <openexr.h>
#include <stddef.h>
#include <stdint.h>

struct libdeflate_decompressor;

/* Lives as long as the pipeline that uses it. All zero at first. */
struct exr_zip {
	struct libdeflate_decompressor *decompressor;
	uint8_t *split; /* a chunk's rearranged bytes */
	size_t split_size;
};

/** Let a decoding pipeline of a ZIP or ZIPS part, its routines chosen, expand with `zip`. */
void exr_zip_decode_with(exr_decode_pipeline_t *decode, struct exr_zip *zip);

/** Call it after the pipeline is destroyed. */
void exr_zip_free(struct exr_zip *zip);
