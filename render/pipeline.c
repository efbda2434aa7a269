#include "render/pipeline.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/queue.h"
#include "look/apply/apply.h"
#include "look/camera/camera.h"
#include "render/alike.h"
#include "render/cryptomatte.h"
#include "render/earlier.h"
#include "render/picture.h"
#include "render/programs.h"
#include "render/supply.h"
#include "render/vectors.h"
#include "scene/release.h"

#define MAX_PATH_BYTES 4096
#define MAX_WRITERS 8
#define ENOUGH_BYTES ((uint64_t)1200 << 20) /* a third frame is not begun where it would take more, whatever --jobs says */

/* A scene that one picture, or all of a turntable, are made of. */
struct shared_scene {
	struct scene *scene;
	atomic_uint users;
};

/* A picture to be made. */
struct shot {
	struct shared_scene *of;
	uint64_t number; /* in file names: the frame's, or the turntable's picture's */
	double replay_s; /* that playing the recording up to it has taken */
};

/* What the threads of one pipeline share. */
struct pipeline_state {
	struct pipeline *p;
	struct blas_cache *cache; /* BLASes that the workers share; NULL: there is only one */
	struct queue shots, pictures;
	struct shared_scene *turned; /* of a turntable, once it is decoded; NULL */
	pthread_mutex_t lock; /* of what follows, and of the progress */
	atomic_int err;       /* the first failure */
	int writer_said;      /* a writer has reported its failure */
	struct worker *seats; /* [n_seats]; started as pictures need them */
	size_t n_seats, n_started;
	unsigned workers;     /* neither ended nor failed, started or not */
	unsigned at_work;     /* of these, started */
	unsigned untraced;    /* pictures handed out and not yet traced */
	unsigned in_flight;   /* pictures handed out and not yet on disk */
	uint64_t frame_bytes; /* most memory that a frame in flight took so far; 0: not known yet */
	uint64_t idle_bytes;  /* memory before the first frame */
	pthread_cond_t landed;
	int begun; /* a picture was handed out */
	struct earlier earlier; /* for motion vectors */
	struct alike alike;     /* why frames failed; under the lock */
};

struct worker {
	struct pipeline_state *state;
	struct device *dev;
	uint64_t done; /* frames that it traced */
	int seat;
	pthread_t thread;
};

struct picture {
	struct image img;
	uint64_t frame;
	double seconds;
};

/* The first failure ends the run; later ones only follow from it. */
static void fail(struct pipeline_state *state, int err)
{
	pthread_mutex_lock(&state->lock);
	if (!state->err)
		state->err = err;
	pthread_mutex_unlock(&state->lock);
	watch_give_up(state->p->watch);
	queue_close(&state->shots);
}

static void leave_scene(struct shared_scene **shared)
{
	struct shared_scene *s = *shared;

	*shared = NULL;
	if (!s || atomic_fetch_sub(&s->users, 1) != 1)
		return;
	scene_release(&s->scene);
	free(s);
}

static void drop_shot(struct shot **shot)
{
	if (*shot)
		leave_scene(&(*shot)->of);
	free(*shot);
	*shot = NULL;
}

/* A picture is done with, made or not. */
static void land(struct pipeline_state *state)
{
	uint64_t now = watch_memory();

	pthread_mutex_lock(&state->lock);
	if (now > state->idle_bytes && (now - state->idle_bytes) / state->in_flight > state->frame_bytes)
		state->frame_bytes = (now - state->idle_bytes) / state->in_flight;
	state->in_flight--;
	pthread_cond_broadcast(&state->landed);
	pthread_mutex_unlock(&state->lock);
}

static void note(struct pipeline_state *state, uint64_t frame, const char *outcome, double seconds)
{
	pthread_mutex_lock(&state->lock);
	progress_frame(state->p->progress, frame, outcome, seconds);
	pthread_mutex_unlock(&state->lock);
}

/* A frame fails, and the run goes on. */
static void note_failed(struct pipeline_state *state, uint64_t frame, double seconds, const char *why)
{
	pthread_mutex_lock(&state->lock);
	alike_note(&state->alike, frame, why);
	progress_frame(state->p->progress, frame, "failed", seconds);
	pthread_mutex_unlock(&state->lock);
}

static void tell_replay(void *user, uint64_t frame, uint64_t played, uint64_t of, const char *why)
{
	struct pipeline_state *state = user;

	pthread_mutex_lock(&state->lock);
	progress_replay(state->p->progress, frame, played, of, why);
	pthread_mutex_unlock(&state->lock);
}

/* --- Decoding ------------------------------------------------------------------------------------------------------ */

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

static void *work(void *arg);

/* Start another worker where pictures would wait for one. @return 0 or ERR_SYSTEM (reported): there is none at all */
static int call_worker(struct pipeline_state *state)
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

static int is_there(const struct pipeline_state *state, uint64_t frame)
{
	char path[MAX_PATH_BYTES];

	return state->p->settings->skip_existing && !frame_pattern_expand(state->p->settings->output, frame, path, sizeof(path)) &&
	       stamp_check(&state->p->stamp, settings_recorded_frame(state->p->settings, frame), path) == STAMP_SAME;
}

/* Replay up to a frame. @return 1; 0: the recording ends before it; ERR_* */
static int go_to(struct pipeline_state *state, uint64_t frame)
{
	const int more = state->p->settings->motion ? earlier_decode(&state->earlier, state->p->replay, frame) : 1;

	return more == 1 ? replay_seek(state->p->replay, frame) : more;
}

/* The scene of the next frame, or the one that all pictures of a turntable are made of. @return 1; 0: the recording has ended; ERR_* */
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
	if (more == 1 && state->p->settings->motion && earlier_note(&state->earlier, shared->scene))
		more = ERR_SYSTEM;
	if (more == 1 && camera_pictures(state->p->settings->camera)) {
		shared->users++;
		state->turned = shared;
	}
	return more;
}

/* Hand out a picture to be made. @return 1; 0: the recording ends before its frame; ERR_* */
static int hand_out(struct pipeline_state *state, uint64_t number)
{
	double start = progress_clock_s(), seconds;
	int more = state->turned ? 1 : go_to(state, settings_recorded_frame(state->p->settings, number));
	struct shot *shot;

	if (more != 1)
		return more;
	seconds = progress_clock_s() - start;
	wait_for_memory(state);
	start = progress_clock_s();
	shot = calloc(1, sizeof(*shot));
	if (shot)
		shot->number = number;
	more = shot ? take_scene(state, &shot->of) : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (more == 1)
		shot->replay_s = seconds + progress_clock_s() - start;
	if (more == 1 && !state->begun++)
		progress_start(state->p->progress, number, progress_clock_s() - state->p->start_s);
	if (more == 1 && call_worker(state))
		more = ERR_SYSTEM;
	if (more == 1 && queue_put(&state->shots, shot))
		return 1;
	drop_shot(&shot);
	land(state);
	return more;
}

static int decode(struct pipeline_state *state)
{
	const struct frame_list *frames = &state->p->settings->frames;
	uint64_t frame = 0;
	int more = 1;

	for (; more == 1 && frame_list_next(frames, frame, &frame) && frame < state->p->end && !watch_is_over(state->p->watch);
	     frame++) {
		if (is_there(state, frame))
			note(state, frame, "skipped", 0);
		else
			more = hand_out(state, frame);
	}
	return more < 0 ? more : 0;
}

/* --- Tracing ------------------------------------------------------------------------------------------------------- */

enum outcome { TRACED, LATE, EMPTY, STOPPED, BROKEN };

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

/* When the program showed the frame, as relume film wants to know. */
static int tell_time(const struct scene *scene, struct image *img)
{
	return scene->time_ns ? image_set_attribute(img, "relume:time", "%llu", (unsigned long long)scene->time_ns) : 0;
}

static enum outcome trace(struct worker *w, struct tracer *tracer, const struct shot *shot, struct picture *picture)
{
	const struct scene *scene = shot->of->scene;
	const struct settings *settings = w->state->p->settings;
	double start = progress_clock_s();
	int err, late;

	picture->frame = shot->number;
	if (!scene->width || !scene->height) { /* no device can do that: the others go on */
		char why[64];

		snprintf(why, sizeof(why), "%u x %u pixels cannot be rendered", scene->width, scene->height);
		note_failed(w->state, shot->number, 0, why);
		return EMPTY;
	}
	watch_begin(w->state->p->watch, w->seat, shot->number);
	/* some need the whole planes */
	picture->img.packers = w->state->p->display || settings->cryptomatte || settings->motion || settings->caustics || settings->denoise ? 0 : packer_count(w->state);
	err = picture_render(settings, tracer, scene, shot->number, &picture->img);
	if (!err && !w->state->turned)
		err = tell_time(scene, &picture->img);
	if (!err)
		err = programs_tell(scene, &picture->img);
	if (!err && settings->motion)
		err = vectors_add(scene, earlier_of(&w->state->earlier, scene->frame), &picture->img);
	if (!err && settings->cryptomatte)
		err = cryptomatte_add(scene, &picture->img);
	late = watch_end(w->state->p->watch, w->seat);
	picture->seconds = shot->replay_s + progress_clock_s() - start;
	if (!err)
		return TRACED;
	if (watch_is_over(w->state->p->watch))
		return STOPPED;
	if (err == ERR_INPUT) { /* the camera's file is not for this frame; others may do */
		note(w->state, shot->number, "failed", picture->seconds);
		return EMPTY;
	}
	return late ? LATE : BROKEN;
}

/* A frame ran out of time: the run goes on, and fails in the end. */
static void give_up(struct pipeline_state *state, const struct picture *picture)
{
	char why[64];

	snprintf(why, sizeof(why), "given up after %g s (--timeout-per-frame)", state->p->settings->frame_s);
	note_failed(state, picture->frame, picture->seconds, why);
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
		if (call_worker(state))
			fail(state, ERR_SYSTEM);
		return;
	}
	fail(state, ERR_SYSTEM);
	drop_shot(&shot);
	land(state);
}

static void add_undrawn(struct pipeline_state *state, const struct tracer *tracer)
{
	const struct tracer_undrawn *u = tracer_undrawn(tracer);

	pthread_mutex_lock(&state->lock);
	state->p->undrawn.targets += u->targets;
	state->p->undrawn.ended += u->ended;
	pthread_mutex_unlock(&state->lock);
}

static void drop_picture(struct picture **picture)
{
	if (*picture)
		image_free(&(*picture)->img);
	free(*picture);
	*picture = NULL;
}

/* Make one picture. @return 1; 0: the device has failed, and this worker ends. *tracer may be NULL afterwards */
static int work_on(struct worker *w, struct tracer **tracer, struct shot *shot)
{
	struct pipeline_state *state = w->state;
	struct picture *picture = calloc(1, sizeof(*picture));
	enum outcome outcome = STOPPED;

	if (!picture)
		fail(state, err_report(ERR_SYSTEM, NULL, "out of memory"));
	else if (!watch_is_over(state->p->watch))
		outcome = trace(w, *tracer, shot, picture);
	if (outcome == BROKEN) {
		drop_picture(&picture);
		retire(state, shot);
		return 0;
	}
	earlier_drop(&state->earlier, shot->number);
	drop_shot(&shot);
	w->done += outcome == TRACED;
	if (outcome == TRACED && queue_put(&state->pictures, picture))
		return 1;
	if (outcome == LATE) {
		give_up(state, picture);
		add_undrawn(state, *tracer);
		tracer_destroy(tracer);
		if (start_tracer(w, tracer))
			fail(state, ERR_SYSTEM);
	}
	drop_picture(&picture);
	land(state);
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
		fail(state, ERR_SYSTEM);
	while (tracer && sound && (shot = queue_take(&state->shots))) {
		sound = work_on(w, &tracer, shot);
		pthread_mutex_lock(&state->lock);
		state->untraced--;
		pthread_mutex_unlock(&state->lock);
	}
	if (tracer)
		add_undrawn(state, tracer);
	tracer_destroy(&tracer);
	pthread_mutex_lock(&state->lock);
	if (sound)
		left = --state->workers;
	pthread_mutex_unlock(&state->lock);
	if (!left)
		queue_close(&state->shots); /* nobody would take them */
	return NULL;
}

/* --- Writing ------------------------------------------------------------------------------------------------------- */

static int write_display(struct pipeline_state *state, const struct image *img, const char *path)
{
	uint64_t bright = 0;
	int err = display_write(state->p->display, img, path, &bright);

	pthread_mutex_lock(&state->lock);
	state->p->pixels += (uint64_t)img->width * img->height;
	state->p->bright += bright;
	pthread_mutex_unlock(&state->lock);
	return err;
}

static int write_picture(struct pipeline_state *state, struct picture *picture)
{
	char path[MAX_PATH_BYTES];
	int err = stamp_image(&state->p->stamp, &picture->img);

	/* how relume film shows it */
	if (!err && !state->p->display && state->p->settings->display.white > 1)
		err = image_set_attribute(&picture->img, "relume:white", "%g", (double)state->p->settings->display.white);
	/* says which channels were left out on purpose */
	if (!err && state->p->settings->tracer.aov && !state->p->display)
		err = image_set_attribute(&picture->img, "relume:aov", "%s", state->p->settings->tracer.aov);

	if (!err)
		err = frame_pattern_expand(state->p->settings->output, picture->frame, path, sizeof(path));
	if (!err)
		err = folder_make_for(path);
	if (err)
		return err;
	return state->p->display ? write_display(state, &picture->img, path) : image_write_exr(&picture->img, path);
}

static void *write_all(void *arg)
{
	struct pipeline_state *state = arg;
	struct picture *picture;

	err_share(&state->writer_said);
	while ((picture = queue_take(&state->pictures))) {
		/* After a signal, write what is traced. After a failure it would only fail again. */
		int err = state->err ? state->err : write_picture(state, picture);

		if (!err)
			note(state, picture->frame, "done", picture->seconds);
		else if (!state->err)
			fail(state, err);
		drop_picture(&picture);
		land(state);
	}
	return NULL;
}

/* --- All together -------------------------------------------------------------------------------------------------- */

/* A core packs a file in about the time it traces one: with one writer for two cores, tracing waits now and then. */
static unsigned writer_count(void)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN);

	return cores < 1 ? 1 : cores < MAX_WRITERS ? (unsigned)cores : MAX_WRITERS;
}

/* Every worker has a queue of its own on its device: the first uses the device as it was opened, the others share it. */
static int seat_workers(struct pipeline_state *state, struct worker *workers, size_t n)
{
	struct pipeline *p = state->p;

	for (size_t i = 0; i < n; i++) {
		struct device *dev = p->devices[i % p->n_devices];

		workers[i].state = state;
		if (i >= p->n_devices && device_share(dev, &workers[i].dev))
			return ERR_SYSTEM;
		if (i < p->n_devices)
			workers[i].dev = dev;
		workers[i].seat = watch_add(p->watch, workers[i].dev);
		if (workers[i].seat < 0)
			return err_report(ERR_USAGE, NULL, "too many devices and --jobs; at most %d together", WATCH_MAX_SEATS);
	}
	return 0;
}

static int start_and_join(struct pipeline_state *state, struct worker *workers, size_t n)
{
	pthread_t writers[MAX_WRITERS];
	unsigned n_writers = 0;
	int err;

	state->seats = workers;
	state->n_seats = n;
	state->workers = (unsigned)n;
	state->idle_bytes = watch_memory();
	while (n_writers < writer_count() && pthread_create(&writers[n_writers], NULL, write_all, state) == 0)
		n_writers++;
	err = n_writers ? decode(state) : err_report(ERR_SYSTEM, NULL, "no thread can be started");
	if (err)
		fail(state, err);
	queue_close(&state->shots);
	for (size_t i = 0; i < state->n_started; i++)
		pthread_join(workers[i].thread, NULL);
	for (struct shot *shot; (shot = queue_take(&state->shots));)
		drop_shot(&shot); /* every worker was gone */
	leave_scene(&state->turned);
	queue_close(&state->pictures);
	for (unsigned i = 0; i < n_writers; i++)
		pthread_join(writers[i], NULL);
	alike_end(&state->alike);
	if (!state->err && state->p->progress->failed)
		state->err = ERR_SYSTEM;
	return state->err;
}

int pipeline_run(struct pipeline *p)
{
	struct pipeline_state state = { .p = p };
	size_t n = p->n_devices * p->jobs;
	struct worker *workers = calloc(n, sizeof(*workers));
	struct supply supply = { .parent = p->devices[0] };
	int err;

	p->shares = calloc(p->n_devices, sizeof(*p->shares));
	err = workers && p->shares ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	pthread_mutex_init(&state.lock, NULL);
	pthread_cond_init(&state.landed, NULL);
	earlier_init(&state.earlier);
	if (!err)
		err = queue_init(&state.shots, n, n);
	if (!err)
		err = queue_init(&state.pictures, writer_count(), 0);
	if (!err && n > 1)
		err = blas_cache_create(BLAS_CACHE_BYTES, &state.cache);
	if (!err)
		err = seat_workers(&state, workers, n);
	supply.cache = state.cache;
	replay_set_supplier(p->replay, supply_picture, &supply);
	replay_set_tell(p->replay, tell_replay, &state);
	if (!look_spares(p->settings->look))
		replay_keep_targets(p->replay);
	if (!err)
		err = start_and_join(&state, workers, n);
	replay_set_supplier(p->replay, NULL, NULL);
	replay_set_tell(p->replay, NULL, NULL);
	supply_free(&supply);
	blas_cache_destroy(&state.cache);
	for (size_t i = 0; workers && p->shares && i < n; i++)
		p->shares[i % p->n_devices] += workers[i].done;
	for (size_t i = 0; workers && i < n; i++)
		if (i >= p->n_devices && workers[i].dev)
			device_close(&workers[i].dev);
	queue_free(&state.shots);
	queue_free(&state.pictures);
	earlier_free(&state.earlier);
	pthread_cond_destroy(&state.landed);
	pthread_mutex_destroy(&state.lock);
	free(workers);
	return err;
}
