/* Packs and unpacks blobs with Snappy. */
#include "replay/index/pack.h"

#include <snappy-c.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define SAMPLE_BYTES 4096u

size_t pack_room(size_t n)
{
	return snappy_max_compressed_length(n);
}

/* 1 if data is small, or if a piece from its middle shrinks by at least a quarter. */
static int is_worth_packing(const char *data, size_t n)
{
	char packed[SAMPLE_BYTES + SAMPLE_BYTES / 6 + 32]; /* snappy_max_compressed_length */
	size_t n_packed = sizeof(packed);

	return n < 16 * SAMPLE_BYTES || snappy_compress(data + n / 2, SAMPLE_BYTES, packed, &n_packed) != SNAPPY_OK ||
	       n_packed <= SAMPLE_BYTES / 4 * 3;
}

int pack_blob(const char *data, size_t n, char *out, size_t *packed)
{
	*packed = pack_room(n);
	if (!is_worth_packing(data, n))
		*packed = n;
	else if (snappy_compress(data, n, out, packed) != SNAPPY_OK)
		return ERR_SYSTEM;
	if (*packed >= n)
		memcpy(out, data, *packed = n);
	return 0;
}

char *unpack_blob(char *packed, size_t n_packed, size_t n)
{
	size_t unpacked;
	char *data;

	if (n_packed == n)
		return packed;
	if (snappy_uncompressed_length(packed, n_packed, &unpacked) != SNAPPY_OK || unpacked != n || !(data = malloc(n + 1)))
		return NULL;
	if (snappy_uncompress(packed, n_packed, data, &unpacked) == SNAPPY_OK)
		return data;
	free(data);
	return NULL;
}
