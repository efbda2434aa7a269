/* A device's baseline.yaml: read, searched, written again, read again. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "diff/baseline/baseline.h"
#include "tests/fuzz/target.h"

static struct image frame;

static void make_frame(void)
{
	image_free(&frame);
	frame.width = 4;
	frame.height = 3;
	if (!image_add_channel(&frame, "R", 0) || image_set_attribute(&frame, "relume:device", "dev"))
		abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct baseline base = { 0 }, again = { 0 };
	char path[4096], folder[4096];

	snprintf(folder, sizeof(folder), "%s/dev", target_folder());
	mkdir(folder, 0777);
	target_write("dev/baseline.yaml", data, size, path);
	if (!frame.width)
		make_frame();
	if (baseline_open(target_folder(), &base))
		return 0;
	baseline_variant_of(&base, "dev");
	for (uint32_t i = 0; base.n_variants && i < base.variants[0]->n_frames && i < 4; i++) {
		struct score_approved approved = { 0 };
		struct image was = { 0 };
		int found;

		baseline_look_up(&base, &frame, base.variants[0]->frames[i].frame, &was, &approved, &found);
		image_free(&was);
	}
	if (base.n_variants && !baseline_write(base.folders[0], base.variants[0])) {
		if (baseline_open(target_folder(), &again))
			abort(); /* must be able to read its own output */
		baseline_close(&again);
	}
	baseline_close(&base);
	return 0;
}
