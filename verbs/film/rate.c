#include "verbs/film/rate.h"

#include <stdlib.h>

#define LOOKS 8u     /* pairs of frames */
#define FAST_NS 22222222u /* a 45th of a second: half way, in frames, between the two rates */

uint64_t rate_time_ns(const struct image *img)
{
	const char *time = image_attribute(img, "relume:time");

	return time ? strtoull(time, NULL, 10) : 0;
}

static int read_time(struct set *frames, size_t i, uint64_t *time_ns)
{
	struct image img = { .width = 0 };
	const int err = set_read(frames, &frames->entries[i], &img);

	*time_ns = err ? 0 : rate_time_ns(&img);
	image_free(&img);
	return err;
}

int rate_choose(struct set *frames, const struct frame_list *wanted, unsigned *fps)
{
	const size_t n = frames->n_entries;
	unsigned fast = 0, known = 0;
	int err = 0;

	for (size_t k = 0, last = SIZE_MAX; k < LOOKS && n > 1 && !err; k++) {
		const size_t i = k * (n - 1) / LOOKS;
		uint64_t begins = 0, ends = 0;

		if (i == last || !frame_list_contains(wanted, frames->entries[i].frame) ||
		    !frame_list_contains(wanted, frames->entries[i + 1].frame))
			continue;
		last = i;
		err = read_time(frames, i, &begins);
		if (!err)
			err = read_time(frames, i + 1, &ends);
		if (!begins || ends <= begins)
			continue;
		known++;
		fast += ends - begins < FAST_NS;
	}
	*fps = 2 * fast > known ? RATE_FAST_FPS : RATE_FPS;
	return err;
}
