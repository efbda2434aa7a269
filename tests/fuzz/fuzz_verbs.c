/*
 * The verbs that read a recording, whole and in one process: the low bits of the first byte choose one. The rest is the trace's file; where the
 * first byte's highest bit is set it is the logical stream in it. What they write goes into a folder of this process.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/verbs.h"
#include "tests/fuzz/target.h"

#define MOST_WORDS 12

static const struct verb {
	int (*main)(int argc, char **argv);
	const char *words[MOST_WORDS]; /* IN and OUT are files */
} verbs[] = {
	{ info_main, { "info", "--json", "--no-sandbox", "IN" } },
	{ scene_main, { "scene", "--json", "-f", "1", "--no-sandbox", "IN" } },
	{ dump_main, { "dump", "--no-sandbox", "IN" } },
	{ repair_main, { "repair", "--no-sandbox", "-o", "OUT.trace", "IN" } },
	{ trim_main, { "trim", "--no-sandbox", "-f", "1", "-o", "OUT.trace", "IN" } },
	{ export_main, { "export", "--no-sandbox", "-f", "0", "-o", "OUT.glb", "IN" } },
	{ index_main, { "index", "--check", "--no-sandbox", "IN" } },
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	char in[4096], out[4200], *argv[MOST_WORDS + 1];
	const struct verb *verb;
	uint8_t which, *packed = NULL;
	int argc = 0, code;

	if (!target_take(&data, &size, &which, 1))
		return 0;
	verb = &verbs[which % 128 % (sizeof(verbs) / sizeof(verbs[0]))];
	if (which & 128)
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
