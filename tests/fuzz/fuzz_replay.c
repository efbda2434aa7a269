/*
 * libFuzzer target for reader and state machine: the input is a trace's logical stream (capture/format/trace.md), which
 * is put into a Snappy container and replayed with the scenes of its first frames, or of every other one. Links no
 * tracer: requests for pixels get grey ones. Most mutations change its calls (stream.h), the others its bytes.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/stream.h"
#include "tests/fuzz/target.h"

#define MAX_FRAMES 8
#define MOST_PIXELS (1u << 20) /* per picture; larger ones are refused, which is faster than filling them */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out,
                                 size_t max_size, unsigned seed);

static int supply(void *user, const struct scene *scene, struct scene_picture *picture)
{
	return (uint64_t)scene->width * scene->height > MOST_PIXELS ? ERR_SYSTEM : calls_grey.supply(user, scene, picture);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	size_t n;
	uint8_t *trace = target_pack(data, size, &n);
	struct replay *rp = NULL;
	struct scene *scene;
	char path[32];
	int file = target_file(trace, n, path);

	free(trace);
	if (!replay_open(&rp, path)) {
		replay_set_supplier(rp, supply, calls_grey.user);
		for (int i = 0; i < MAX_FRAMES && replay_next_frame(rp, size % 4 || i % 2, &scene) == 1; i++)
			scene_release(&scene);
	}
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

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out,
                                 size_t max_size, unsigned seed)
{
	return stream_change(a, a_size, b, b_size, out, max_size, &seed);
}
