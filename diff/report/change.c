/* Finds the approved version of a frame, and marks where they differ. */
#include "diff/report/change.h"

#include <string.h>

#include "base/err.h"
#include "diff/score/approved.h"

/* Mark differences in channels other than colours: the same device gives the same numbers. */
static void mark_numbers(const struct image *now, const struct image *was, uint8_t *off)
{
	const size_t n = (size_t)now->width * now->height;

	for (size_t c = 0; c < now->n_channels; c++) {
		const float *a = image_values(now, c), *b = image_channel(was, now->channels[c].name);

		for (size_t i = 0; a && b && i < n; i++)
			off[i] |= memcmp(&a[i], &b[i], sizeof(*a)) != 0;
	}
}

static int mark(const struct image *traced, const struct score_approved *approved, const uint8_t *ignore,
                struct change *out)
{
	const size_t n = (size_t)traced->width * traced->height;
	int any = 0;

	out->off = calloc(n ? n : 1, 1);
	if (!out->off)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	approved_mark(traced, &out->image, out->off);
	for (size_t i = 0; i < n; i++)
		any |= out->off[i] &= !(ignore && ignore[i]);
	if (!any && approved->same_device)
		mark_numbers(traced, &out->image, out->off);
	return 0;
}

int change_find(const struct baseline *baseline, const struct image *traced, uint64_t frame, const uint8_t *ignore,
                struct change *out)
{
	struct score_approved approved;
	int found, err = baseline_look_up(baseline, traced, frame, &out->image, &approved, &found);

	if (err || !approved.image)
		return err;
	err = score_picture_from_image(&out->image, "beauty", &out->was);
	if (!err)
		err = score_picture_from_image(traced, "beauty", &out->now);
	if (!err && out->image.width == traced->width && out->image.height == traced->height)
		err = mark(traced, &approved, ignore, out);
	return err == ERR_INPUT ? 0 : err; /* one of them has no colours */
}

void change_free(struct change *change)
{
	score_picture_free(&change->was);
	score_picture_free(&change->now);
	image_free(&change->image);
	free(change->off);
	*change = (struct change){ .off = NULL };
}
