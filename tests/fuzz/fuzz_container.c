/*
 * Traces as files: Snappy chunks, gzip, Brotli. Every complete call is read as text twice: sequentially, and by
 * seeking.
 */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "replay/trace/container.h"
#include "replay/trace/reader.h"
#include "replay/trace/text.h"
#include "tests/fuzz/target.h"

#define MOST_CALLS 20000
#define MOST_BYTES ((size_t)64 << 20) /* a decompression bomb is endless, and is read piece by piece */

static FILE *nowhere;

static void read_bytes(const char *path)
{
	struct container *c = NULL;
	const uint8_t *piece;
	uint64_t hash[2];
	size_t n, all = 0;

	if (container_open(&c, path))
		return;
	if (container_hash_begin(c) == 0) {
		while (all < MOST_BYTES && container_next(c, &piece, &n) == 1)
			all += n;
		container_hash_end(c, hash);
	}
	container_close(&c);
}

static void read_calls(struct trace_reader *r, int most, struct trace_place *half)
{
	const struct call *call;

	for (int i = 0; i < most && trace_reader_next(r, &call) == 1; i++) {
		text_call(nowhere, call);
		if (half && i == most / 2 && !trace_reader_place(r, half))
			half->number = 0;
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct trace_reader *r = NULL;
	struct trace_place half = { .number = 0 };
	uint8_t *signatures = NULL;
	size_t n_signatures = 0;
	char path[32];
	int file = target_file(data, size, path);

	nowhere = nowhere ? nowhere : fopen("/dev/null", "w");
	read_bytes(path);
	if (!trace_reader_open(&r, path, NULL)) {
		read_calls(r, size % 64 ? 200 : MOST_CALLS, &half);
		if (half.number && !trace_reader_signatures(r, &signatures, &n_signatures) &&
		    !trace_reader_seek(r, &half, signatures, n_signatures))
			read_calls(r, 200, NULL);
	}
	trace_reader_close(&r);
	free(signatures);
	close(file);
	return 0;
}
