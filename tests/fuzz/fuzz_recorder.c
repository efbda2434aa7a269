/*
 * The recorder's reads of program memory: texts, lists of texts, blobs and pixels at any address, with some pages
 * unmapped. The input is the first bytes of the memory, and calls. Results are compared: bytes must be unchanged, and
 * zeros where a page is missing.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "capture/format/sizes.h"
#include "capture/write/pages.h"
#include "capture/write/recording.h"
#include "capture/write/values.h"
#include "tests/fuzz/target.h"

#define PAGE ((size_t)4096)
#define PAGES 8
#define FILLED 256 /* bytes of the input that are repeated over the memory */
#define MOST_BYTES (PAGE * PAGES)

/* One call: kind, address (or a wild one), size. */
struct __attribute__((packed)) step {
	uint8_t what, wild;
	uint16_t at;
	int32_t size, more[5];
};

struct recording recording;
static uint8_t chunk[1 << 20], *memory, there;

uint8_t *recording_spill(uint8_t *p, int now)
{
	(void)now;
	if (p > recording.end)
		abort();
	return recording.chunk;
}

static void map(const uint8_t *bytes)
{
	if (!memory) {
		memory = mmap(NULL, MOST_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
		if (memory == MAP_FAILED)
			abort();
	}
	mprotect(memory, MOST_BYTES, PROT_READ | PROT_WRITE);
	for (size_t i = 0; i < MOST_BYTES; i++)
		memory[i] = bytes[i % FILLED];
	there = bytes[0];
	for (size_t i = 0; i < PAGES; i++)
		if (!(there >> i & 1))
			mprotect(memory + i * PAGE, PAGE, PROT_NONE);
}

static uint8_t expected(size_t at, const uint8_t *bytes)
{
	return there >> at / PAGE & 1 ? bytes[at % FILLED] : 0;
}

/* Compared byte by byte. */
static void read_and_compare(size_t at, size_t n, const uint8_t *bytes)
{
	static uint8_t copy[MOST_BYTES];
	size_t lost = 0;

	n = n < MOST_BYTES - at ? n : MOST_BYTES - at;
	for (size_t i = 0; i < n; i++)
		lost += !(there >> (at + i) / PAGE & 1);
	if (pages_read(copy, memory + at, n) != lost)
		abort();
	for (size_t i = 0; i < n; i++)
		if (copy[i] != expected(at + i, bytes))
			abort();
}

static void read_text(size_t at, const uint8_t *bytes)
{
	size_t n = 0;

	while (at + n < MOST_BYTES && there >> (at + n) / PAGE & 1 && bytes[(at + n) % FILLED])
		n++;
	if (at + n < MOST_BYTES && pages_text_bytes((const char *)memory + at) != n)
		abort();
}

static void run(const struct step *s, const uint8_t *bytes)
{
	const size_t at = s->at % MOST_BYTES;
	const uint8_t *from = s->wild % 4 ? memory + at : (const uint8_t *)(uintptr_t)(uint32_t)s->size;
	const long size = s->size % (int32_t)(4 * MOST_BYTES);
	const struct pixel_layout layout = { s->more[0], s->more[1], s->more[2], s->more[3], s->more[4], s->size };
	const struct pixel_box box = { 1 + s->what % 3, (unsigned)s->more[0], (unsigned)s->more[1],
		                       s->more[2],      s->more[3],           s->more[4] };
	long n;

	recording.chunk = recording.p = chunk;
	recording.end = chunk + sizeof(chunk);
	switch (s->what % 8) {
	case 0: read_and_compare(at, (size_t)(s->size & 0xffff), bytes); break;
	case 1: read_text(at, bytes); break;
	case 2: put_blob(chunk, from, size); break;
	case 3: put_string(chunk, (const char *)from, size); break;
	case 4:
		put_strings(chunk, (const char *const *)(const void *)from, size % 16,
		            s->wild & 8 ? (const int *)(const void *)(memory + at) : NULL);
		break;
	case 5:
		n = image_bytes(&layout, &box);
		put_blob(chunk, from, n < (long)(4 * MOST_BYTES) ? n : 0);
		break;
	case 6:
		if (s->wild & 16 && size > 16) /* shorter ones are read directly */
			put_array_f32(chunk, (const float *)(const void *)from, size);
		else
			put_zeros(chunk, from, size % 4096);
		break;
	default:
		map1_count((unsigned)s->more[0], s->more[1], s->more[2]);
		map2_count((unsigned)s->more[0], s->more[1], s->more[2], s->more[3], s->more[4]);
		call_lists_bytes(s->more[0], (unsigned)s->more[1]);
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	uint8_t bytes[FILLED];
	struct step s;

	if (!target_take(&data, &size, bytes, sizeof(bytes)))
		return 0;
	map(bytes);
	while (target_take(&data, &size, &s, sizeof(s)))
		run(&s, bytes);
	return 0;
}
