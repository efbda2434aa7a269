#include "tracer/image/exr_zip.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

/* Make a buffer hold at least `size` bytes; its content is lost. */
static int reserve(uint8_t **buffer, size_t *have, size_t size)
{
	if (*have >= size)
		return 1;
	free(*buffer);
	*buffer = malloc(size);
	*have = *buffer ? size : 0;
	return *buffer != NULL;
}

/* Undo exr_pack.h's rearrangement: add up the differences, and interleave both halves. */
static void sum_and_join(const uint8_t *in, uint8_t *out, size_t n)
{
	const size_t half = (n + 1) / 2;
	uint8_t sum = 128;

	for (size_t i = 0; i < half; i++)
		out[2 * i] = sum = (uint8_t)(sum + in[i] - 128);
	for (size_t i = half; i < n; i++)
		out[2 * (i - half) + 1] = sum = (uint8_t)(sum + in[i] - 128);
}

/* A decompress_fn. Chunks of their raw size are stored uncompressed. */
static exr_result_t expand_chunk(exr_decode_pipeline_t *decode)
{
	struct exr_zip *zip = decode->decoding_user_data;
	const size_t n_packed = decode->chunk.packed_size, n = decode->chunk.unpacked_size;
	size_t n_found = 0;

	if (n_packed == n) {
		if (decode->unpacked_buffer != decode->packed_buffer)
			memcpy(decode->unpacked_buffer, decode->packed_buffer, n);
		return EXR_ERR_SUCCESS;
	}
	if (!zip->decompressor)
		zip->decompressor = libdeflate_alloc_decompressor();
	if (!zip->decompressor || !reserve(&zip->split, &zip->split_size, n))
		return EXR_ERR_OUT_OF_MEMORY;
	if (libdeflate_zlib_decompress(zip->decompressor, decode->packed_buffer, n_packed, zip->split, n, &n_found) !=
	    LIBDEFLATE_SUCCESS || n_found != n)
		return EXR_ERR_CORRUPT_CHUNK;
	sum_and_join(zip->split, decode->unpacked_buffer, n);
	return EXR_ERR_SUCCESS;
}

void exr_zip_decode_with(exr_decode_pipeline_t *decode, struct exr_zip *zip)
{
	decode->decoding_user_data = zip;
	decode->decompress_fn = expand_chunk;
}

void exr_zip_free(struct exr_zip *zip)
{
	if (zip->decompressor)
		libdeflate_free_decompressor(zip->decompressor);
	free(zip->split);
	*zip = (struct exr_zip){ 0 };
}
