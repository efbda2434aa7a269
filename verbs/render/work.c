#include "verbs/render/work.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "verbs/render/picture.h"

enum frame_end { TRACED, LATE, EMPTY, STOPPED, BROKEN };

static int start_tracer(const struct worker *w, struct tracer **out)
{
	int err = tracer_create(out, w->dev);

	if (!err)
		tracer_share(*out, w->state->cache);
	return err;
}

/* Threads for packing a picture: its share of the cores among the frames under way. */
static unsigned packer_count(struct pipeline_state *state)
{
	const long cores = sysconf(_SC_NPROCESSORS_ONLN);
	unsigned in_flight;

	pthread_mutex_lock(&state->lock);
	in_flight = state->in_flight;
	pthread_mutex_unlock(&state->lock);
	return cores > (long)in_flight ? (unsigned)cores / in_flight : 1;
}

/* A frame that a worker samples. */
struct sampled {
	struct pipeline_state *state;
	uint64_t frame;
};

static void note_sample(void *user, uint32_t done, uint32_t of)
{
	const struct sampled *s = user;

	pthread_mutex_lock(&s->state->lock);
	progress_sample(&s->state->p->carried->progress, s->frame, done, of);
	pthread_mutex_unlock(&s->state->lock);
}

static enum frame_end trace(struct worker *w, struct tracer *tracer, const struct shot *shot, struct picture *picture)
{
	const struct scene *scene = shot->of->scene; /* all have its size */
	const struct settings *settings = w->state->p->settings;
	struct sampled sampled = { w->state, shot->number };
	const struct picture_listener listener = { note_sample, &sampled };
	double start = progress_clock_s();
	int err, late;

	picture->frame = shot->number;
	if (!scene->width || !scene->height) { /* no device can do that: the others go on */
		char why[64];

		snprintf(why, sizeof(why), "%u x %u pixels cannot be rendered", scene->width, scene->height);
		pipeline_note_failed(w->state, shot->number, 0, why);
		return EMPTY;
	}
	device_set_frame(w->dev, shot->number);
	watch_begin(w->state->p->watch, w->seat, shot->number);
	/* some need the whole planes */
	picture->img.packers = w->state->p->display || settings->cryptomatte || settings->motion ||
	                                       settings->caustics || settings->denoise ?
	                               0 :
	                               packer_count(w->state);
	err = picture_render(settings, tracer, shot, &listener, &picture->img);
	late = watch_end(w->state->p->watch, w->seat);
	picture->seconds = shot->replay_s + progress_clock_s() - start;
	if (!err)
		return TRACED;
	if (watch_is_over(w->state->p->watch))
		return STOPPED;
	if (err == ERR_INPUT) { /* the camera's file is not for this frame; others may do */
		pipeline_note(w->state, shot->number, "failed", picture->seconds);
		return EMPTY;
	}
	return late ? LATE : BROKEN;
}

/* A frame ran out of time: the run goes on, and fails in the end. */
static void give_up(struct pipeline_state *state, const struct picture *picture)
{
	char why[64];

	snprintf(why, sizeof(why), "given up after %g s (--timeout-per-frame)", state->p->settings->frame_s);
	pipeline_note_failed(state, picture->frame, picture->seconds, why);
}

static void *work(void *arg);

int pipeline_call_worker(struct pipeline_state *state)
{
	int err = 0;

	pthread_mutex_lock(&state->lock);
	state->untraced++;
	if (state->n_started < state->n_seats && state->at_work < state->untraced) {
		struct worker *w = &state->seats[state->n_started];

		if (pthread_create(&w->thread, NULL, work, w) == 0) {
			state->n_started++;
			state->at_work++;
		} else if (state->at_work == 0) {
			err = err_report(ERR_SYSTEM, NULL, "no thread can be started");
		}
	}
	pthread_mutex_unlock(&state->lock);
	return err;
}

/* The device failed: others take the picture, or the run ends. */
static void retire(struct pipeline_state *state, struct shot *shot)
{
	unsigned left;

	pthread_mutex_lock(&state->lock);
	left = --state->workers;
	state->at_work--;
	pthread_mutex_unlock(&state->lock);
	if (left) {
		err_warn(NULL, "frame %llu goes to another device or queue; this one is not used again",
		         (unsigned long long)shot->number);
		queue_put_back(&state->shots, shot);
		if (pipeline_call_worker(state))
			pipeline_fail(state, ERR_SYSTEM);
		return;
	}
	pipeline_fail(state, ERR_SYSTEM);
	shot_drop(&shot);
	pipeline_land(state);
}

/* A frame was tried: add what its tracer counted. Where it is the first after a fault, the family that took over is
 * right. */
static void note_frame(struct worker *w, const struct tracer *tracer, int is_traced, int has_dome)
{
	const struct tracer_undrawn *u = tracer_undrawn(tracer);
	const struct tracer_added *added = tracer_added(tracer);
	struct carried *c = w->state->p->carried;
	int is_first;

	pthread_mutex_lock(&w->state->lock);
	c->undrawn.targets += u->targets - w->undrawn.targets;
	c->undrawn.ended += u->ended - w->undrawn.ended;
	tracer_added_add(&c->added, added, &w->added);
	c->has_dome |= has_dome;
	c->made += (uint64_t)is_traced;
	is_first = is_traced && carried_confirms(c, w->dev);
	pthread_mutex_unlock(&w->state->lock);
	w->undrawn = *u;
	w->added = *added;
	if (is_first)
		outcome_confirm(w->dev, w->state->p->remembered, &c->run);
}

/* Make one picture. @return 1; 0: the device has failed, and this worker ends. *tracer may be NULL afterwards */
static int work_on(struct worker *w, struct tracer **tracer, struct shot *shot)
{
	struct pipeline_state *state = w->state;
	struct picture *picture = calloc(1, sizeof(*picture));
	enum frame_end outcome = STOPPED;

	if (!picture)
		pipeline_fail(state, err_report(ERR_SYSTEM, NULL, "out of memory"));
	else if (!watch_is_over(state->p->watch))
		outcome = trace(w, *tracer, shot, picture);
	if (outcome == BROKEN) {
		pipeline_drop_picture(&picture);
		retire(state, shot);
		return 0;
	}
	shot_drop(&shot);
	note_frame(w, *tracer, outcome == TRACED, outcome == TRACED && image_attribute(&picture->img, "relume:dimmed"));
	w->done += outcome == TRACED;
	if (outcome == TRACED && queue_put(&state->pictures, picture))
		return 1;
	if (outcome == LATE) {
		give_up(state, picture);
		tracer_destroy(tracer);
		w->undrawn = (struct tracer_undrawn){ 0 };
		w->added = (struct tracer_added){ 0 };
		if (start_tracer(w, tracer))
			pipeline_fail(state, ERR_SYSTEM);
	}
	pipeline_drop_picture(&picture);
	pipeline_land(state);
	return 1;
}

static void *work(void *arg)
{
	struct worker *w = arg;
	struct pipeline_state *state = w->state;
	struct tracer *tracer = NULL;
	struct shot *shot;
	unsigned left = 1;
	int sound = 1;

	if (start_tracer(w, &tracer))
		pipeline_fail(state, ERR_SYSTEM);
	while (tracer && sound && (shot = queue_take(&state->shots))) {
		sound = work_on(w, &tracer, shot);
		pthread_mutex_lock(&state->lock);
		state->untraced--;
		pthread_mutex_unlock(&state->lock);
	}
	tracer_destroy(&tracer);
	pthread_mutex_lock(&state->lock);
	if (sound)
		left = --state->workers;
	pthread_mutex_unlock(&state->lock);
	if (!left)
		queue_close(&state->shots); /* nobody would take them */
	return NULL;
}
