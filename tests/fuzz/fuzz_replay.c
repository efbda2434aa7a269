/*
 * libFuzzer's target for reader and state machine: the input is a trace's logical stream (see capture/format/trace.md), put into a
 * Snappy container and replayed with the scenes of its first frames, or of every other one. Links no tracer: a frame that needs pixels goes without.
 * Most changes are to its calls (stream.h), the others to its bytes.
 */
#include <snappy-c.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "replay/replay.h"
#include "scene/release.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/stream.h"

#define CHUNK ((size_t)1 << 20)
#define MAX_FRAMES 8

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t max_size,
                                 unsigned seed);

/* What is reported about damaged input is of no interest here. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	(void)argc;
	(void)argv;
	return freopen("/dev/null", "w", stdout) ? 0 : 1;
}

static void write_trace(int file, const uint8_t *data, size_t size)
{
	size_t room = snappy_max_compressed_length(CHUNK);
	char *packed = malloc(room);

	if (!packed || write(file, "at", 2) != 2)
		abort();
	for (size_t at = 0; at < size; at += CHUNK) {
		size_t n = room, part = size - at < CHUNK ? size - at : CHUNK;
		uint32_t length;
		if (snappy_compress((const char *)data + at, part, packed, &n) != SNAPPY_OK)
			abort();
		length = (uint32_t)n;
		if (write(file, &length, 4) != 4 || write(file, packed, n) != (ssize_t)n)
			abort();
	}
	free(packed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	int file = memfd_create("fuzz", MFD_CLOEXEC);
	struct replay *rp = NULL;
	struct scene *scene;
	char path[32];

	if (file < 0)
		abort();
	write_trace(file, data, size);
	snprintf(path, sizeof(path), "/proc/self/fd/%d", file);
	if (!replay_open(&rp, path))
		for (int i = 0; i < MAX_FRAMES && replay_next_frame(rp, size % 4 || i % 2, &scene) == 1; i++)
			scene_release(&scene);
	replay_close(&rp);
	close(file);
	return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
	uint8_t *out = calls_draw(&seed, 8) ? malloc(max_size) : NULL;
	size_t n = out ? stream_change(data, size, NULL, 0, out, max_size, &seed) : 0;

	if (n)
		memcpy(data, out, n);
	free(out);
	return n ? n : LLVMFuzzerMutate(data, size, max_size);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t max_size,
                                 unsigned seed)
{
	return stream_change(a, a_size, b, b_size, out, max_size, &seed);
}
