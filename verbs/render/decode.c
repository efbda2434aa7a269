#include "verbs/render/decode.h"

#include <stdlib.h>
#include <time.h>

#include "base/err.h"
#include "look/camera/camera.h"
#include "verbs/render/work.h"

/* a third frame is not begun where it would take more, whatever --jobs says */
#define ENOUGH_BYTES ((uint64_t)1200 << 20)

/* Whether memory is short for another frame. A limit lets the first go alone, to see what it takes. */
static int is_crowded(const struct pipeline_state *state)
{
	const uint64_t limit = state->p->settings->memory_bytes, most = limit ? limit : ENOUGH_BYTES;

	return state->in_flight >= (limit ? 1 : 2) &&
	       (!state->frame_bytes || state->idle_bytes + state->frame_bytes * (state->in_flight + 1) > most);
}

static void wait_for_memory(struct pipeline_state *state)
{
	pthread_mutex_lock(&state->lock);
	while (is_crowded(state) && !watch_is_over(state->p->watch)) {
		struct timespec until;

		clock_gettime(CLOCK_REALTIME, &until);
		until.tv_sec++; /* notice a signal within a second */
		pthread_cond_timedwait(&state->landed, &state->lock, &until);
	}
	state->in_flight++;
	pthread_mutex_unlock(&state->lock);
}

static int is_there(const struct pipeline_state *state, uint64_t frame)
{
	char path[PIPELINE_PATH_BYTES];

	return state->p->settings->skip_existing &&
	       !frame_pattern_expand(state->p->settings->output, frame, path, sizeof(path)) &&
	       stamp_check(&state->p->stamp, settings_recorded_frame(state->p->settings, frame), path) == STAMP_SAME;
}

/* Keep what the replay has met so far, in case this process ends before the report. */
static void note_lacks(const struct pipeline *p)
{
	const struct replay_count *counts;
	const size_t n = replay_unsupported(p->replay, &counts);

	for (size_t i = 0; i < n; i++)
		p->carried->lacks |= !replay_is_rendered(&counts[i]);
}

/* The frames that a picture takes. */
static void range_of(const struct settings *s, uint64_t number, uint64_t *low, uint64_t *high)
{
	const struct moments *m = &s->moments;
	double at;

	moments_at(m, number, s->motion ? -1 : -0.5 * m->shutter, low, &at);
	moments_at(m, number, 0.5 * m->shutter, high, &at);
	*high += at > 0;
}

/* The frames that no picture from this one on takes. */
static void let_go(struct pipeline_state *state, uint64_t number)
{
	uint64_t low, high;

	range_of(state->p->settings, number, &low, &high);
	while (state->held && (state->held_frame < low || state->held_frame > high)) {
		struct shared_scene *next = state->held->next;

		if (next)
			next->users++;
		shot_leave_scene(&state->held);
		state->held = next;
		state->held_frame++;
	}
}

/* Replay up to the first frame that is not held. @return 1; 0: the recording ends before it; ERR_* */
static int go_to(struct pipeline_state *state, uint64_t number)
{
	uint64_t low, high;

	let_go(state, number);
	range_of(state->p->settings, number, &low, &high);
	if (state->held && state->held_frame != low)
		shot_leave_scene(&state->held);
	return state->held ? 1 : replay_seek(state->p->replay, low);
}

/* @param out  receives the frame, with one user. @return 1; 0: the recording ends before it; ERR_* */
static int decode(struct pipeline_state *state, uint64_t frame, struct shared_scene **out)
{
	struct shared_scene *shared = calloc(1, sizeof(*shared));
	int more;

	if (!shared)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	shared->users = 1;
	more = replay_seek(state->p->replay, frame);
	if (more == 1)
		more = replay_next_frame(state->p->replay, 1, &shared->scene);
	note_lacks(state->p);
	if (more == 1)
		*out = shared;
	else
		shot_leave_scene(&shared);
	return more;
}

/* The frames of a picture: those that are held, and the rest. As decode */
static int take_frames(struct pipeline_state *state, struct shot *shot)
{
	const struct settings *s = state->p->settings;
	struct shared_scene *last;
	uint64_t high;
	int more = 1;

	range_of(s, shot->number, &shot->first, &high);
	if (!state->held) {
		more = decode(state, shot->first, &state->held);
		state->held_frame = shot->first;
	}
	last = state->held;
	for (uint64_t frame = shot->first; more == 1 && frame < high; frame++, last = last->next) {
		if (!last->next)
			more = decode(state, frame + 1, &last->next);
		if (more != 1 || last->after || !settings_mixes(s))
			continue;
		last->after = interval_new(last->scene, last->next->scene);
		more = last->after ? 1 : ERR_SYSTEM;
	}
	if (more != 1)
		return more;
	state->held->users++;
	shot->of = state->held;
	return 1;
}

/* Have programs ready when the first scene is. */
static void prepare_devices(const struct pipeline *p)
{
	for (size_t i = 0; i < p->n_devices; i++)
		device_build_early(p->devices[i]);
}

/* Hand out a picture to be made. @return 1; 0: the recording ends before its frame; ERR_* */
static int hand_out(struct pipeline_state *state, uint64_t number)
{
	double start = progress_clock_s(), seconds;
	struct shot *shot;
	int more;

	state->decoded = number;
	if (!state->begun)
		prepare_devices(state->p);
	more = go_to(state, number);
	if (more != 1)
		return more;
	seconds = progress_clock_s() - start;
	wait_for_memory(state);
	start = progress_clock_s();
	shot = calloc(1, sizeof(*shot));
	if (shot)
		shot->number = number;
	if (!shot)
		more = err_report(ERR_SYSTEM, NULL, "out of memory");
	else
		more = take_frames(state, shot);
	if (more == 1)
		shot->replay_s = seconds + progress_clock_s() - start;
	if (more == 1 && !state->begun++ && state->p->carried->guard.attempt <= 1)
		progress_start(&state->p->carried->progress, number, progress_clock_s() - state->p->start_s);
	if (more == 1 && pipeline_call_worker(state))
		more = ERR_SYSTEM;
	if (more == 1 && queue_put(&state->shots, shot))
		return 1;
	shot_drop(&shot);
	pipeline_land(state);
	return more;
}

/* The frame that a driver failed on, so that another family tries it before all others; UINT64_MAX: none. */
static uint64_t first_of(const struct pipeline *p)
{
	const int64_t first = p->carried->first;

	return first < 0 || carried_is_done(p->carried, (uint64_t)first) ? UINT64_MAX : (uint64_t)first;
}

/* Frames that no picture behind one takes. */
static void let_go_behind(struct pipeline_state *state, uint64_t number)
{
	uint64_t next;

	if (frame_list_next(&state->p->settings->frames, number + 1, &next) && next < state->p->end)
		let_go(state, next);
	else
		shot_leave_scene(&state->held);
}

int pipeline_decode(struct pipeline_state *state)
{
	const struct frame_list *frames = &state->p->settings->frames;
	const uint64_t first = first_of(state->p);
	uint64_t frame = 0;
	int more = 1;

	if (first != UINT64_MAX)
		more = hand_out(state, first);
	for (; more == 1 && frame_list_next(frames, frame, &frame) && frame < state->p->end && !watch_is_over(state->p->watch);
	     frame++) {
		if (carried_is_done(state->p->carried, frame) || frame == first)
			continue;
		if (is_there(state, frame))
			pipeline_note(state, frame, "skipped", 0);
		else
			more = hand_out(state, frame);
		let_go_behind(state, frame);
	}
	return more < 0 ? more : 0;
}
