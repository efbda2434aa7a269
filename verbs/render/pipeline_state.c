#include "verbs/render/pipeline_state.h"

#include <stdlib.h>

void pipeline_fail(struct pipeline_state *state, int err)
{
	pthread_mutex_lock(&state->lock);
	if (!state->err)
		state->err = err;
	pthread_mutex_unlock(&state->lock);
	watch_give_up(state->p->watch);
	queue_close(&state->shots);
}

void pipeline_land(struct pipeline_state *state)
{
	uint64_t now = watch_memory();

	pthread_mutex_lock(&state->lock);
	if (now > state->idle_bytes && (now - state->idle_bytes) / state->in_flight > state->frame_bytes)
		state->frame_bytes = (now - state->idle_bytes) / state->in_flight;
	state->in_flight--;
	pthread_cond_broadcast(&state->landed);
	pthread_mutex_unlock(&state->lock);
}

void pipeline_note(struct pipeline_state *state, uint64_t frame, const char *outcome, double seconds)
{
	pthread_mutex_lock(&state->lock);
	carried_set_done(state->p->carried, frame);
	progress_frame(&state->p->carried->progress, frame, outcome, seconds);
	pthread_mutex_unlock(&state->lock);
}

void pipeline_note_failed(struct pipeline_state *state, uint64_t frame, double seconds, const char *why)
{
	pthread_mutex_lock(&state->lock);
	alike_note(&state->alike, frame, why);
	carried_set_done(state->p->carried, frame);
	progress_frame(&state->p->carried->progress, frame, "failed", seconds);
	pthread_mutex_unlock(&state->lock);
}

void pipeline_drop_picture(struct picture **picture)
{
	if (*picture)
		image_free(&(*picture)->img);
	free(*picture);
	*picture = NULL;
}
