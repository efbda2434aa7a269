#include "tracer/frame/bands/staged.h"

#include <string.h>

#include "base/err.h"
#include "tracer/frame/bands/hook_rays.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/picture/compose.h"
#include "tracer/frame/picture/picture.h"

int staged_suits(const struct job *job)
{
	(void)job;
	return 1;
}

/* Make room for the band's pixels. */
static int reserve_pixels(struct job *job)
{
	struct tracer *tr = job->tr;
	int err = frame_reserve_counts(job);

	if (!err)
		err = frame_reserve(tr, counts, job->n_pixels);
	if (!err)
		err = frame_reserve(tr, frame, job->n_pixels);
	if (!err)
		err = frame_reserve(tr, cleared, 1);
	if (!err)
		err = frame_reserve(tr, drawn, frame_columns(job->width) * job->n_rows);
	for (uint32_t i = 0; i < job->n_samples && !err; i++)
		err = launch_reserve(tr->dev, *frame_sample(job, i), job->n_pixels);
	if (!err && job->n_passes > 1)
		err = frame_reserve(tr, sums, (size_t)job->width * job->height * PASS_PARTS);
	if (!err)
		err = frame_reserve(tr, visibility, 3);
	return err;
}

/* Set pixels to their values before they are drawn. n_cleared: receives the number of the first segment's clears that
 * this includes */
static int begin_band(struct job *job, uint32_t *n_cleared)
{
	int err;

	*n_cleared = 0;
	memset(job->background, 0, sizeof(job->background));
	if (!job->scene->start && !job->scene->needs_previous)
		return segment_clear_all(job, n_cleared);
	err = segment_say_drawn(job, 1);
	return err ? err : picture_upload_start(job);
}

/* Pass on the band's pixels. */
static int end_band(struct job *job)
{
	int err;

	if (job->pass > 0) {
		/* A partly added pass cannot be added again. */
		err = segment_add_pass(job, job->is_first);
		return err == ERR_MEMORY ? device_report_lack(job->tr->dev) : err;
	}
	err = !job->scene->start && job->scene->needs_previous ? picture_count_band(job) : 0;
	if (err)
		return err;
	return job->image ? compose_band(job, job->image) : picture_read_band(job, job->picture);
}

int staged_band(struct job *job)
{
	uint32_t n_cleared;
	int err = reserve_pixels(job);

	if (!err)
		err = begin_band(job, &n_cleared);
	for (uint32_t i = 0; i < job->prepared.n_segments && !err; i++) {
		const struct segment *segment = &job->prepared.segments[i];
		const uint32_t done = i == 0 ? n_cleared : 0;

		err = hook_rays_stand_in(job, segment) ? hook_rays_run(job, segment, done) : segment_run(job, segment, done);
	}
	if (!err && job->n_samples > 1)
		err = segment_merge_samples(job);
	return err ? err : end_band(job);
}
