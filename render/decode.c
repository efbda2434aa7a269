#include "render/decode.h"

#include <stdlib.h>
#include <time.h>

#include "base/err.h"
#include "look/camera/camera.h"
#include "render/work.h"

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

/* Replay up to a frame. @return 1; 0: the recording ends before it; ERR_* */
static int go_to(struct pipeline_state *state, uint64_t frame)
{
	const int more = state->p->settings->motion ? earlier_decode(&state->earlier, state->p->replay, frame) : 1;

	return more == 1 ? replay_seek(state->p->replay, frame) : more;
}

/* What replay has met so far is known, should this process end before the report. */
static void note_lacks(const struct pipeline *p)
{
	const struct replay_count *counts;
	const size_t n = replay_unsupported(p->replay, &counts);

	for (size_t i = 0; i < n; i++)
		p->carried->lacks |= !replay_is_rendered(&counts[i]);
}

/* The scene of the next frame, or the one that all pictures of a turntable are made of. @return 1; 0: the recording has
 * ended; ERR_* */
static int take_scene(struct pipeline_state *state, struct shared_scene **out)
{
	struct shared_scene *shared = state->turned ? state->turned : calloc(1, sizeof(*shared));
	int more = 1;

	if (!shared)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	shared->users++;
	*out = shared;
	if (state->turned)
		return 1;
	more = replay_next_frame(state->p->replay, 1, &shared->scene);
	note_lacks(state->p);
	if (more == 1 && state->p->settings->motion && earlier_note(&state->earlier, shared->scene))
		more = ERR_SYSTEM;
	if (more == 1 && camera_pictures(state->p->settings->camera)) {
		shared->users++;
		state->turned = shared;
	}
	return more;
}

/* A recorded frame that a moment is at or behind (k 0) or before (1). @return 1; 0: the recording ends before it; ERR_*
 */
static int hold(struct pipeline_state *state, int k, uint64_t frame)
{
	struct shared_scene *shared;
	int more;

	if (state->held[k] && state->held_frame[k] == frame)
		return 1;
	pipeline_leave_scene(&state->held[k]);
	state->held_frame[k] = frame;
	if (!k && state->held[1] && state->held_frame[1] == frame) {
		state->held[0] = state->held[1];
		state->held[1] = NULL;
		return 1;
	}
	shared = calloc(1, sizeof(*shared));
	if (!shared)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	shared->users = 1;
	more = replay_seek(state->p->replay, frame);
	if (more == 1)
		more = replay_next_frame(state->p->replay, 1, &shared->scene);
	note_lacks(state->p);
	if (more == 1)
		state->held[k] = shared;
	else
		pipeline_leave_scene(&shared);
	return more;
}

/* The scene between the frames that are held. @return 1 or ERR_SYSTEM (reported) */
static int bridge(struct pipeline_state *state, double at, struct shared_scene *shared)
{
	shared->between = calloc(1, sizeof(*shared->between));
	if (!shared->between)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (int k = 0; k < 2; k++) {
		state->held[k]->users++;
		shared->ends[k] = state->held[k];
	}
	shared->scene = &shared->between->scene;
	return between_make(state->held[0]->scene, state->held[1]->scene, at, shared->between) ? ERR_SYSTEM : 1;
}

/* The scene of a picture's moment. As take_scene */
static int take_moment(struct pipeline_state *state, uint64_t picture, struct shared_scene **out)
{
	uint64_t frame;
	double at;
	int more;

	moments_at(&state->p->settings->moments, picture, &frame, &at);
	more = hold(state, 0, frame);
	if (more == 1 && at > 0)
		more = hold(state, 1, frame + 1);
	if (more != 1)
		return more;
	if (!(at > 0)) {
		state->held[0]->users++;
		*out = state->held[0];
		return 1;
	}
	*out = calloc(1, sizeof(**out));
	if (!*out)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	(*out)->users = 1;
	return bridge(state, at, *out);
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
	if (state->turned || state->p->settings->moments.count)
		more = 1;
	else
		more = go_to(state, settings_recorded_frame(state->p->settings, number));
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
	else if (state->p->settings->moments.count)
		more = take_moment(state, number, &shot->of);
	else
		more = take_scene(state, &shot->of);
	if (more == 1)
		shot->replay_s = seconds + progress_clock_s() - start;
	if (more == 1 && !state->begun++ && state->p->carried->guard.attempt <= 1)
		progress_start(&state->p->carried->progress, number, progress_clock_s() - state->p->start_s);
	if (more == 1 && pipeline_call_worker(state))
		more = ERR_SYSTEM;
	if (more == 1 && queue_put(&state->shots, shot))
		return 1;
	pipeline_drop_shot(&shot);
	pipeline_land(state);
	return more;
}

/* The frame that a driver failed on, so that another family tries it before all others; UINT64_MAX: none. Motion wants
 * frames in their order. */
static uint64_t first_of(const struct pipeline *p)
{
	const int64_t first = p->carried->first;

	return first < 0 || p->settings->motion || carried_is_done(p->carried, (uint64_t)first) ? UINT64_MAX : (uint64_t)first;
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
	}
	return more < 0 ? more : 0;
}
