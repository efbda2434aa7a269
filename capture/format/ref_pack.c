#include "capture/format/ref_pack.h"

#include <snappy-c.h>
#include <string.h>

size_t ref_pack_room(size_t n)
{
	return sizeof(struct ref_head) + sizeof(uint64_t) + snappy_max_compressed_length(4 * n);
}

/* Moving pictures compress better with like bytes side by side. */
static void find_changes(const uint32_t *pixels, const uint32_t *before, size_t n, uint8_t *planes)
{
	for (size_t i = 0; i < n; i++) {
		const uint32_t changed = pixels[i] ^ before[i];

		planes[i] = (uint8_t)changed;
		planes[n + i] = (uint8_t)(changed >> 8);
		planes[2 * n + i] = (uint8_t)(changed >> 16);
		planes[3 * n + i] = (uint8_t)(changed >> 24);
	}
}

size_t ref_pack(struct ref_last *last, const struct ref_head *head, uint64_t at, const uint32_t *pixels,
                const uint32_t *before, uint8_t *planes, uint8_t *out)
{
	const size_t n = (size_t)head->width * head->height;
	const int is_whole = last->width != head->width || last->height != head->height || last->in_a_row == REF_MOST_CHANGED;
	const uint64_t base = last->at;
	const size_t ahead = is_whole ? 0 : sizeof(base);
	struct ref_head made = *head;
	uint8_t *block = out + sizeof(made) + ahead;
	size_t bytes = snappy_max_compressed_length(4 * n);

	if (!is_whole)
		find_changes(pixels, before, n, planes);
	if (snappy_compress(is_whole ? (const char *)pixels : (const char *)planes, 4 * n, (char *)block, &bytes) != SNAPPY_OK)
		return 0;
	memcpy(out + sizeof(made), &base, ahead);
	made.kind |= is_whole ? 0 : REF_CHANGED;
	made.packed_bytes = bytes + ahead;
	memcpy(out, &made, sizeof(made));
	*last = (struct ref_last){ at, made.width, made.height, is_whole ? 0 : last->in_a_row + 1,
		                   is_whole ? bytes : last->whole_bytes };
	if (bytes > last->whole_bytes) /* another picture: the next one is whole again */
		last->in_a_row = REF_MOST_CHANGED;
	return sizeof(made) + made.packed_bytes;
}
