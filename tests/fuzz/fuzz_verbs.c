/*
 * The verbs that read a recording, run completely in one process, and their data in replays that go back; the low bits
 * of the first byte select one. The rest is the trace's file, or, if the highest bit of the first byte is set, the
 * logical stream in it, with most mutations applied to its calls (stream.h). Output goes to a folder of this process.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/verbs.h"
#include "replay/gl/surface/drawable.h"
#include "replay/machine/machine.h"
#include "replay/play/player.h"
#include "scene/release.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/stream.h"
#include "tests/fuzz/target.h"

#define MOST_WORDS 12
#define MOST_FRAMES 8
/* largest drawable whose picture is made: each pixel takes at least 9 bytes, in several pictures */
#define MOST_PIXELS (1u << 23)
#define STREAM 128 /* flag in the first byte */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size) __attribute__((weak)); /* missing in drive.c */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

static int has_large_drawable(const struct gls_exec *x)
{
	for (size_t i = 0; i < x->drawables.room; i++) {
		const struct gls_drawable *d = x->drawables.entries[i].value;

		if (d && (uint64_t)d->width * d->height > MOST_PIXELS)
			return 1;
	}
	return 0;
}

/* Build the scenes of most frames, with pixels unrelated to them; after each, save, load and save the state again. */
static int states_main(int argc, char **argv)
{
	struct player p;
	struct scene *scene = NULL;
	int wrong = 0;

	if (player_open(&p, argv[argc - 1]))
		return 3;
	player_set_supplier(&p, calls_grey.supply, calls_grey.user);
	for (int i = 0;
	     i < MOST_FRAMES && !wrong && player_try_frame(&p, i % 4 != 2, &scene) == 1 && !p.exec->feedback.rewind;
	     i++) {
		scene_release(&scene);
		if (has_large_drawable(p.exec))
			break;
		wrong = calls_check_snapshot(p.exec);
	}
	scene_release(&scene);
	player_close(&p);
	return wrong;
}

static const struct verb {
	int (*main)(int argc, char **argv);
	const char *words[MOST_WORDS]; /* IN and OUT are replaced by files */
} verbs[] = {
	{ info_main, { "info", "--json", "--no-sandbox", "IN" } },
	{ scene_main, { "scene", "--json", "-f", "1", "--no-sandbox", "IN" } },
	{ dump_main, { "dump", "--no-sandbox", "IN" } },
	{ repair_main, { "repair", "--no-sandbox", "-o", "OUT.trace", "IN" } },
	{ trim_main, { "trim", "--no-sandbox", "-f", "1", "-o", "OUT.trace", "IN" } },
	{ export_main, { "export", "--no-sandbox", "-f", "0", "-o", "OUT.glb", "IN" } },
	{ index_main, { "index", "--check", "--no-sandbox", "IN" } },
	{ info_main, { "info", "--no-sandbox", "IN" } },
	{ scene_main, { "scene", "-f", "0", "--no-sandbox", "IN" } },
	{ states_main, { "states", "IN" } },
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	char in[4096], out[4200], *argv[MOST_WORDS + 1];
	const struct verb *verb;
	uint8_t which, *packed = NULL;
	int argc = 0, code;

	if (!target_take(&data, &size, &which, 1))
		return 0;
	verb = &verbs[which % STREAM % (sizeof(verbs) / sizeof(verbs[0]))];
	if (which & STREAM)
		packed = target_pack(data, size, &size);
	target_write("in.trace", packed ? packed : data, size, in);
	free(packed);
	for (; argc < MOST_WORDS && verb->words[argc]; argc++) {
		const char *word = verb->words[argc];

		if (strncmp(word, "OUT", 3) == 0)
			snprintf(out, sizeof(out), "%s/out%s", target_folder(), word + 3);
		argv[argc] = strcmp(word, "IN") == 0 ? in : strncmp(word, "OUT", 3) == 0 ? out : (char *)(uintptr_t)word;
	}
	argv[argc] = NULL;
	code = verb->main(argc, argv);
	if (code != 0 && code != 2 && code != 3)
		abort();
	snprintf(out, sizeof(out), "%s.index", in);
	unlink(out);
	return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
	uint8_t *out = size > 1 && data[0] & STREAM && calls_draw(&seed, 8) ? malloc(max_size) : NULL;
	size_t n = out ? stream_change(data + 1, size - 1, NULL, 0, out, max_size - 1, &seed) : 0;

	if (n)
		memcpy(data + 1, out, n);
	free(out);
	return n ? 1 + n : LLVMFuzzerMutate(data, size, max_size);
}
