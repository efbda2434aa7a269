#include "tracer/image/exr_pack.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <isa-l/igzip_lib.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/optimize.h"

/*
 * Huffman codes from assumed symbol frequencies: a difference of 0 is byte 128, and most matches have the shortest or
 * the longest length. With one table for all chunks, the frames of twelve programs take 3 % more bytes than with
 * ISA-L's level 1, which makes a table for each chunk, and less time. Level 1 of ISA-L 2.30 also gave different bytes
 * for the same rows, about once in 18,000 chunks.
 */
static struct isal_hufftables codes;

static void make_codes(void)
{
	struct isal_huff_histogram count = { 0 };
	const int end = 256, shortest = 257, longest = 285;

	for (int i = 0; i < end; i++)
		count.lit_len_histogram[i] = 30 + 250 / (1 + 4 * (uint64_t)abs(i - 128));
	count.lit_len_histogram[end] = 1;
	for (int i = shortest; i < longest; i++)
		count.lit_len_histogram[i] = 20 + 400 / (uint64_t)(1 + i - shortest);
	count.lit_len_histogram[longest] = 600;
	for (int i = 0; i < ISAL_DEF_DIST_SYMBOLS; i++)
		count.dist_histogram[i] = 1;
	isal_create_hufftables(&codes, &count);
}

/* The two streams that a chunk is split into. */
struct streams {
	uint8_t *even, *odd;
	uint8_t last_even, last_odd; /* the previous byte of each stream */
};

#ifdef __x86_64__
#define FOR_WIDTHS OPTIMIZE("O3") __attribute__((target_clones("avx2", "default")))
#else
#define FOR_WIDTHS /* vectors are in the architecture's baseline */
#endif

/* Append 16-bit words: low bytes to the even stream, high bytes to the odd one, each as a difference. */
FOR_WIDTHS
static void split(struct streams *s, const uint16_t *restrict in, size_t n)
{
	uint8_t *restrict even = s->even, *restrict odd = s->odd;

	if (n == 0)
		return;
	even[0] = (uint8_t)(in[0] - s->last_even + 128);
	odd[0] = (uint8_t)((in[0] >> 8) - s->last_odd + 128);
	for (size_t i = 1; i < n; i++) {
		even[i] = (uint8_t)(in[i] - in[i - 1] + 128);
		odd[i] = (uint8_t)((in[i] >> 8) - (in[i - 1] >> 8) + 128);
	}
	s->last_even = (uint8_t)in[n - 1];
	s->last_odd = (uint8_t)(in[n - 1] >> 8);
	s->even += n;
	s->odd += n;
}

/* --- Lines of a channel ------------------------------------------------------------------------------------------ */

static size_t pairs_of(const struct exr_plane *p, uint32_t width)
{
	return (size_t)width * (p->full_float ? 2 : 1);
}

static float value_at(const struct exr_plane *p, size_t at)
{
	return p->halves ? imath_half_to_float(p->halves[at]) : p->floats[at];
}

/* Are all n values equal to the first? */
static int is_constant(const struct exr_plane *p, size_t at, size_t n)
{
	const size_t bytes = p->halves ? sizeof(*p->halves) : sizeof(*p->floats);
	const char *plane = p->halves ? (const char *)p->halves : (const char *)p->floats;

	return memcmp(plane + at * bytes, plane + (at + 1) * bytes, (n - 1) * bytes) == 0;
}

/* One line in the file's format; `room` receives lines that have to be converted. */
static const uint16_t *line_of(const struct exr_plane *p, size_t at, uint32_t width, uint16_t *room)
{
	if (p->halves && !p->full_float)
		return p->halves + at;
	if (p->floats && p->full_float)
		return (const uint16_t *)(const void *)(p->floats + at);
	for (uint32_t x = 0; x < width; x++) {
		const float value = value_at(p, at + x);

		if (p->full_float)
			memcpy(room + 2 * (size_t)x, &value, sizeof(value));
		else
			room[x] = imath_float_to_half(value);
	}
	return room;
}

/* --- Chunks ------------------------------------------------------------------------------------------------------ */

/* A hash of the values if all pixels of a chunk are equal; 0: they are not. Such chunks repeat, and are packed once. */
static uint64_t name_constant(const struct exr_rows *r)
{
	const size_t at = (size_t)r->first * r->width, n = (size_t)r->count * r->width;
	uint64_t name = n;

	for (size_t i = 0; i < r->n_planes; i++)
		if (!is_constant(&r->planes[i], at, n))
			return 0;
	for (size_t i = 0; i < r->n_planes; i++) {
		const struct { float value; int full_float; } c = { value_at(&r->planes[i], at), r->planes[i].full_float };

		name = XXH3_64bits_withSeed(&c, sizeof(c), name);
	}
	return name ? name : 1;
}

/* Make room for a chunk of n bytes and a line of `line` bytes, and for the packed chunk. */
static int reserve(struct exr_packer *packer, size_t n, size_t line)
{
	const size_t size = n + line;

	if (packer->size < size) {
		free(packer->bytes);
		packer->bytes = malloc(size);
		packer->size = packer->bytes ? size : 0;
	}
	if (packer->packed_size < n) {
		free(packer->packed);
		packer->packed = malloc(n);
		packer->packed_size = packer->packed ? n : 0;
	}
	return packer->bytes && packer->packed ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory for rows of a picture");
}

static void split_rows(const struct exr_rows *r, struct streams *s, uint16_t *room)
{
	for (uint32_t y = r->first; y < r->first + r->count; y++)
		for (size_t i = 0; i < r->n_planes; i++)
			split(s, line_of(&r->planes[i], (size_t)y * r->width, r->width, room), pairs_of(&r->planes[i], r->width));
}

/* Store a chunk uncompressed. Readers treat a chunk of its raw size as raw bytes, so a chunk that does not shrink is
 * stored. */
static size_t store(const struct exr_rows *r, uint8_t *out, uint16_t *room)
{
	uint8_t *at = out;

	for (uint32_t y = r->first; y < r->first + r->count; y++)
		for (size_t i = 0; i < r->n_planes; i++) {
			const size_t bytes = 2 * pairs_of(&r->planes[i], r->width);

			memcpy(at, line_of(&r->planes[i], (size_t)y * r->width, r->width, room), bytes);
			at += bytes;
		}
	return (size_t)(at - out);
}

/* @return number of bytes; 0: deflating does not shrink the chunk */
static size_t deflate_bytes(uint8_t *in, size_t n, uint8_t *out)
{
	static pthread_once_t once = PTHREAD_ONCE_INIT;
	/* isal_deflate_stateless_init() does not set hist_bits; an arbitrary window size gives other bytes */
	struct isal_zstream z = { 0 };

	pthread_once(&once, make_codes);
	isal_deflate_stateless_init(&z);
	z.hufftables = &codes;
	z.gzip_flag = IGZIP_ZLIB;
	z.end_of_stream = 1;
	z.next_in = in;
	z.avail_in = (uint32_t)n;
	z.next_out = out;
	z.avail_out = (uint32_t)(n - 1);
	return isal_deflate_stateless(&z) == COMP_OK && z.avail_in == 0 ? z.total_out : 0;
}

int exr_pack(struct exr_packer *packer, const struct exr_rows *r)
{
	const uint64_t constant = name_constant(r);
	size_t n = 0, line = (size_t)r->width * sizeof(float);
	struct streams s = { .last_even = 0 };
	uint16_t *room;

	if (constant && constant == packer->constant)
		return 0;
	for (size_t i = 0; i < r->n_planes; i++)
		n += 2 * pairs_of(&r->planes[i], r->width) * r->count;
	packer->constant = 0;
	if (reserve(packer, n, line))
		return ERR_SYSTEM;
	room = (uint16_t *)(void *)packer->bytes;
	s.even = packer->bytes + line;
	s.odd = s.even + n / 2;
	s.last_even = 128; /* makes the difference of the very first byte the byte itself */
	split_rows(r, &s, room);
	s.odd[-(ptrdiff_t)(n / 2)] -= s.last_even; /* the odd bytes follow the even ones */
	packer->n_packed = deflate_bytes(s.even - n / 2, n, packer->packed);
	if (packer->n_packed == 0)
		packer->n_packed = store(r, packer->packed, room);
	packer->constant = constant;
	return 0;
}

void exr_packer_free(struct exr_packer *packer)
{
	free(packer->bytes);
	free(packer->packed);
	*packer = (struct exr_packer){ 0 };
}
