#include "tracer/image/exr_zip.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL 4 /* a fifth more bytes than zlib's level 6, and several times faster */

/* Make a buffer of at least `size` bytes; its content is lost. */
static int reserve(uint8_t **buffer, size_t *have, size_t size)
{
	if (*have >= size)
		return 1;
	free(*buffer);
	*buffer = malloc(size);
	*have = *buffer ? size : 0;
	return *buffer != NULL;
}

/* O3 makes vector loops of these; -O2 does not. */
__attribute__((optimize("O3"))) static void split_and_difference(const uint8_t *restrict in, uint8_t *restrict out, size_t n)
{
	const size_t half = (n + 1) / 2;

	if (n == 0)
		return;
	out[0] = in[0];
	for (size_t i = 1; i < half; i++)
		out[i] = (uint8_t)(in[2 * i] - in[2 * i - 2] + 128);
	if (n > 1)
		out[half] = (uint8_t)(in[1] - in[2 * half - 2] + 128);
	for (size_t i = 1; i < n / 2; i++)
		out[half + i] = (uint8_t)(in[2 * i + 1] - in[2 * i - 1] + 128);
}

static void sum_and_join(const uint8_t *in, uint8_t *out, size_t n)
{
	const size_t half = (n + 1) / 2;
	uint8_t sum = 128;

	for (size_t i = 0; i < half; i++)
		out[2 * i] = sum = (uint8_t)(sum + in[i] - 128);
	for (size_t i = half; i < n; i++)
		out[2 * (i - half) + 1] = sum = (uint8_t)(sum + in[i] - 128);
}

static exr_result_t compress_chunk(exr_encode_pipeline_t *encode)
{
	struct exr_zip *zip = encode->encoding_user_data;
	const size_t n = encode->packed_bytes;

	if (!zip->compressor)
		zip->compressor = libdeflate_alloc_compressor(LEVEL);
	if (!zip->compressor || !reserve(&zip->split, &zip->split_size, n) || !reserve(&zip->packed, &zip->packed_size, n))
		return EXR_ERR_OUT_OF_MEMORY;
	split_and_difference(encode->packed_buffer, zip->split, n);
	/* Readers take a chunk of its raw size for raw bytes: store one that does not shrink. */
	encode->compressed_bytes = n ? libdeflate_zlib_compress(zip->compressor, zip->split, n, zip->packed, n - 1) : 0;
	encode->compressed_buffer = zip->packed;
	encode->compressed_alloc_size = 0; /* ours, not the pipeline's */
	if (encode->compressed_bytes == 0) {
		memcpy(zip->packed, encode->packed_buffer, n);
		encode->compressed_bytes = n;
	}
	return EXR_ERR_SUCCESS;
}

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

void exr_zip_encode_with(exr_encode_pipeline_t *encode, struct exr_zip *zip)
{
	encode->encoding_user_data = zip;
	encode->compress_fn = compress_chunk;
}

void exr_zip_decode_with(exr_decode_pipeline_t *decode, struct exr_zip *zip)
{
	decode->decoding_user_data = zip;
	decode->decompress_fn = expand_chunk;
}

void exr_zip_free(struct exr_zip *zip)
{
	if (zip->compressor)
		libdeflate_free_compressor(zip->compressor);
	if (zip->decompressor)
		libdeflate_free_decompressor(zip->decompressor);
	free(zip->split);
	free(zip->packed);
	*zip = (struct exr_zip){ 0 };
}
