#include "verbs/render/moments.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"

#define SNAP 1e-6 /* share of the time between two frames: a moment this close to a frame is that frame */
#define MOST_PICTURES 1e9

/* Seconds of frames, by the clock or at a rate that is not 0. @return 0 or ERR_* (reported) */
static int read_clock(struct moments *m, struct replay *replay, const char *trace, double rate)
{
	uint64_t *times = malloc((m->first + m->n) * sizeof(*times));
	int err = times ? replay_frame_times(replay, m->first + m->n, times) : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (uint64_t i = 0; i < m->n && !err; i++) {
		const uint64_t frame = m->first + i, time = times[frame];

		if (rate > 0) {
			m->seconds[i] = (double)i / rate;
			continue;
		}
		if (!time || (i && time < times[frame - 1]))
			err = err_report(ERR_INPUT, trace,
			                 "does not tell when frame %llu was shown; --recorded-fps says how many frames it has a second",
			                 (unsigned long long)frame);
		m->seconds[i] = (double)(time - times[m->first]) * 1e-9;
	}
	if (!err)
		m->first_ns = times[m->first];
	free(times);
	return err;
}

int moments_make(struct moments *m, struct replay *replay, const char *trace, const struct frame_list *frames,
                 uint64_t end, double fps, double recorded_fps)
{
	uint64_t last = end - 1;
	int err;

	if (frames->n_ranges > 1 || (frames->n_ranges && frames->ranges[0].step != 1))
		return err_report(ERR_USAGE, NULL, "--fps goes from one frame to another: -f FIRST-LAST, or all frames");
	if (frames->n_ranges) {
		m->first = frames->ranges[0].first;
		last = frames->ranges[0].last < last ? frames->ranges[0].last : last;
	}
	m->n = last - m->first + 1;
	m->seconds = malloc(m->n * sizeof(*m->seconds));
	if (!m->seconds)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = read_clock(m, replay, trace, recorded_fps);
	if (err)
		return err;
	m->fps = fps;
	if (m->seconds[m->n - 1] * fps > MOST_PICTURES)
		return err_report(ERR_USAGE, trace, "%g pictures a second of %g seconds are too many", fps, m->seconds[m->n - 1]);
	m->count = (uint64_t)(m->seconds[m->n - 1] * fps + SNAP) + 1;
	return 0;
}

void moments_free(struct moments *m)
{
	free(m->seconds);
	*m = (struct moments){ .fps = 0 };
}

/* The last frame up to a time, counted from m->first. */
static uint64_t last_until(const struct moments *m, double seconds)
{
	uint64_t low = 0, high = m->n;

	while (high - low > 1) {
		const uint64_t middle = low + (high - low) / 2;

		if (m->seconds[middle] <= seconds)
			low = middle;
		else
			high = middle;
	}
	return low;
}

void moments_at(const struct moments *m, uint64_t picture, double after, uint64_t *frame, double *at)
{
	const double last = (double)(m->n - 1);
	double place = (double)picture - (double)m->first + after; /* in frames */
	uint64_t low;

	if (m->fps > 0) {
		const double time = ((double)picture + after) / m->fps;

		low = last_until(m, time);
		place = (double)low;
		if (low + 1 < m->n)
			place += (time - m->seconds[low]) / (m->seconds[low + 1] - m->seconds[low]);
	}
	place = place > 0 ? place < last ? place : last : 0;
	low = (uint64_t)(place + SNAP);
	*at = place - (double)low > SNAP ? place - (double)low : 0;
	*frame = m->first + low;
}

uint64_t moments_time(const struct moments *m, uint64_t picture)
{
	return m->first_ns + (uint64_t)((double)picture / m->fps * 1e9) + !m->first_ns;
}

uint64_t moments_nearest(const struct moments *m, uint64_t picture)
{
	uint64_t frame;
	double at;

	moments_at(m, picture, 0, &frame, &at);
	return at < 0.5 ? frame : frame + 1;
}
