#include "tracer/frame/bands/staged.h"

#include <string.h>

#include "base/err.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/bands/hook_rays.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/picture/compose.h"
#include "tracer/frame/picture/picture.h"

int staged_suits(const struct pass *pass)
{
	(void)pass;
	return 1;
}

/* Make room for the band's pixels. */
static int reserve_pixels(const struct band *band)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	int err = band_reserve_counts(band);

	if (!err)
		err = launch_reserve(tr->dev, tr->band->counts, band->n_pixels);
	if (!err)
		err = launch_reserve(tr->dev, tr->pixels.frame, band->n_pixels);
	if (!err)
		err = launch_reserve(tr->dev, tr->band->cleared, 1);
	if (!err)
		err = launch_reserve(tr->dev, tr->band->drawn, frame_columns(frame->width) * band->n_rows);
	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++)
		err = launch_reserve(tr->dev, *frame_sample(band->pass, i), band->n_pixels);
	if (!err && band->pass->count > 1)
		err = compose_reserve_sums(frame);
	return err;
}

/* Set pixels to their values before they are drawn. n_cleared: receives the number of the first segment's clears that
 * this includes */
static int begin_band(struct band *band, uint32_t *n_cleared)
{
	int err;

	*n_cleared = 0;
	memset(band->background, 0, sizeof(band->background));
	if (!band->frame->scene->start && !band->frame->scene->needs_previous)
		return segment_clear_all(band, n_cleared);
	err = segment_say_drawn(band, 1);
	return err ? err : picture_upload_start(band);
}

/* Pass on the band's pixels. */
static int end_band(const struct band *band)
{
	const struct frame *frame = band->frame;
	int err;

	if (band->pass->number > 0) {
		/* A partly added pass cannot be added again. */
		err = compose_add_pass(band);
		return err == ERR_MEMORY ? device_report_lack(frame->tr->dev) : err;
	}
	err = !frame->scene->start && frame->scene->needs_previous ? picture_count_band(band) : 0;
	if (err)
		return err;
	return band->pass->image ? compose_band(band, frame->tr->band->cleared, frame->tr->band->drawn) :
	                           picture_read_band(band, band->pass->picture);
}

int staged_band(struct band *band)
{
	const struct frame *frame = band->frame;
	uint32_t n_cleared;
	int err = reserve_pixels(band);

	if (!err)
		err = begin_band(band, &n_cleared);
	for (uint32_t i = 0; i < frame->prepared.n_segments && !err; i++) {
		const struct segment *segment = &frame->prepared.segments[i];
		const uint32_t done = i == 0 ? n_cleared : 0;

		err = hook_rays_stand_in(frame, segment) ? hook_rays_run(band, segment, done) :
		                                           segment_run(band, segment, done);
	}
	if (!err && band->pass->n_samples > 1)
		err = segment_merge_samples(band);
	return err ? err : end_band(band);
}
