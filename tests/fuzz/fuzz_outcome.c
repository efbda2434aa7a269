/* Stored facts about devices, and cached kernels: files of base/kept.h. The first byte is used as in fuzz_tree.c. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/kept.h"
#include "tests/fuzz/target.h"
#include "tracer/device/outcome.h"

static const struct device_description device = {
	.name = "device", .platform = "platform", .driver = "1", .version = "OpenCL 1.2"
};
static char file[4096];
static uint64_t key[2];

static void begin(void)
{
	const struct outcome outcome = { .families = { { .state = OUTCOME_RIGHT } } };
	char folder[4096], head[24];
	struct dirent *entry;
	FILE *in = NULL;
	DIR *dir;

	snprintf(folder, sizeof(folder), "%s/devices", target_folder());
	outcome_write(folder, &device, &outcome);
	dir = opendir(folder);
	while (dir && (entry = readdir(dir)))
		if (strstr(entry->d_name, ".outcome") &&
		    snprintf(file, sizeof(file), "%s/%.255s", folder, entry->d_name) < (int)sizeof(file))
			in = fopen(file, "rb");
	if (!in || fread(head, 1, sizeof(head), in) != sizeof(head))
		abort();
	memcpy(key, head + 8, sizeof(key));
	fclose(in);
	closedir(dir);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	char folder[4096], text[160];
	struct outcome outcome;
	uint8_t how;
	FILE *out;

	if (!file[0])
		begin();
	if (!target_take(&data, &size, &how, 1))
		return 0;
	if (how % 2 == 0) {
		if (kept_write(file, key, data, size))
			abort();
	} else {
		out = fopen(file, "wb");
		if (!out || fwrite(data, 1, size, out) != size || fclose(out))
			abort();
	}
	snprintf(folder, sizeof(folder), "%s/devices", target_folder());
	if (outcome_read(folder, &device, &outcome)) {
		outcome_best(&outcome, FAMILY_PACKETS);
		for (int i = 0; i < N_DEVICE_FAMILIES; i++)
			outcome_words(&outcome.families[i], text, sizeof(text));
	}
	return 0;
}
