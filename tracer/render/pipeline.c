#include "tracer/render/pipeline.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/queue.h"
#include "tracer/render/supply.h"

#define MAX_PATH_BYTES 4096
#define MAX_WRITERS 8

struct run {
	struct pipeline *p;
	struct grove *grove; /* trees that the workers share; NULL: there is only one */
	struct queue scenes, pictures;
	pthread_mutex_t lock; /* of what follows, and of the progress */
	atomic_int err;       /* the first failure */
	int writer_said;        /* a writer has reported its failure */
	unsigned workers;     /* still at work */
	unsigned in_flight;   /* scenes handed out and not yet on disk */
	uint64_t frame_bytes; /* memory that a frame on its way takes, as far as seen; 0: not known yet */
	uint64_t idle_bytes;  /* memory before the first frame */
	pthread_cond_t landed;
	int begun; /* a scene was handed out */
};

struct worker {
	struct run *run;
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

/* The first failure ends the run; what others say while it ends is no news. */
static void fail(struct run *run, int err)
{
	pthread_mutex_lock(&run->lock);
	if (!run->err)
		run->err = err;
	pthread_mutex_unlock(&run->lock);
	watch_give_up(run->p->watch);
	queue_close(&run->scenes);
}

/* A scene or picture is off the way. */
static void land(struct run *run)
{
	uint64_t now = watch_memory();

	pthread_mutex_lock(&run->lock);
	if (now > run->idle_bytes && (now - run->idle_bytes) / run->in_flight > run->frame_bytes)
		run->frame_bytes = (now - run->idle_bytes) / run->in_flight;
	run->in_flight--;
	pthread_cond_broadcast(&run->landed);
	pthread_mutex_unlock(&run->lock);
}

static void note(struct run *run, uint64_t frame, const char *state, double seconds)
{
	pthread_mutex_lock(&run->lock);
	progress_frame(run->p->progress, frame, state, seconds);
	pthread_mutex_unlock(&run->lock);
}

/* --- Decoding ------------------------------------------------------------------------------------------------------ */

/*
 * Wait until another frame may be on its way within the memory limit. The first one goes alone and shows what a frame takes.
 */
static void wait_for_memory(struct run *run)
{
	uint64_t limit = run->p->settings->memory_bytes;

	pthread_mutex_lock(&run->lock);
	while (limit && run->in_flight && !watch_is_over(run->p->watch) &&
	       (!run->frame_bytes || run->idle_bytes + run->frame_bytes * (run->in_flight + 1) > limit)) {
		struct timespec until;

		clock_gettime(CLOCK_REALTIME, &until);
		until.tv_sec++; /* a signal is seen within a second */
		pthread_cond_timedwait(&run->landed, &run->lock, &until);
	}
	run->in_flight++;
	pthread_mutex_unlock(&run->lock);
}

static int is_there(const struct run *run, uint64_t frame)
{
	char path[MAX_PATH_BYTES];

	return run->p->settings->skip_existing && !frame_pattern_expand(run->p->settings->output, frame, path, sizeof(path)) &&
	       stamp_check(&run->p->stamp, frame, path) == STAMP_SAME;
}

/* Execute up to a frame and hand out its scene. @return 1; 0 the recording ends before it; ERR_* */
static int hand_out(struct run *run, uint64_t frame)
{
	struct scene *scene = NULL;
	int more = replay_seek(run->p->replay, frame);

	if (more != 1)
		return more;
	wait_for_memory(run);
	more = replay_next_frame(run->p->replay, 1, &scene);
	if (more == 1 && !run->begun++)
		progress_start(run->p->progress, frame, progress_clock_s() - run->p->start_s);
	if (more == 1 && queue_put(&run->scenes, scene))
		return 1;
	scene_release(&scene);
	land(run);
	return more;
}

static int decode(struct run *run)
{
	const struct frame_list *frames = &run->p->settings->frames;
	uint64_t frame = 0;
	int more = 1;

	for (; more == 1 && frame_list_next(frames, frame, &frame) && frame < run->p->end && !watch_is_over(run->p->watch);
	     frame++) {
		if (is_there(run, frame))
			note(run, frame, "skipped", 0);
		else
			more = hand_out(run, frame);
	}
	return more < 0 ? more : 0;
}

/* --- Tracing ------------------------------------------------------------------------------------------------------- */

enum outcome { TRACED, LATE, STOPPED, BROKEN };

static int start_tracer(const struct worker *w, struct tracer **out)
{
	int err = tracer_create(out, w->dev);

	if (!err)
		tracer_share(*out, w->run->grove);
	return err;
}

static enum outcome trace(struct worker *w, struct tracer *tracer, const struct scene *scene, struct picture *picture)
{
	double start = progress_clock_s();
	int err, late;

	watch_begin(w->run->p->watch, w->seat, scene->frame);
	err = tracer_render(tracer, scene, &w->run->p->settings->tracer, &picture->img);
	late = watch_end(w->run->p->watch, w->seat);
	picture->frame = scene->frame;
	picture->seconds = progress_clock_s() - start;
	if (!err)
		return TRACED;
	if (watch_is_over(w->run->p->watch))
		return STOPPED;
	return late ? LATE : BROKEN;
}

/* A frame was given up: the run goes on, and will have failed. */
static void give_up(struct run *run, const struct picture *picture)
{
	err_report(ERR_SYSTEM, NULL, "frame %llu: given up after %.1f s (--timeout-per-frame)",
	           (unsigned long long)picture->frame, picture->seconds);
	note(run, picture->frame, "failed", picture->seconds);
}

/* The device failed: others take the scene, or the run ends. */
static void retire(struct run *run, struct scene *scene)
{
	unsigned left;

	pthread_mutex_lock(&run->lock);
	left = --run->workers;
	pthread_mutex_unlock(&run->lock);
	if (left) {
		err_warn(NULL, "frame %llu goes to another device or queue; this one is not used again",
		         (unsigned long long)scene->frame);
		queue_put_back(&run->scenes, scene);
		return;
	}
	fail(run, ERR_SYSTEM);
	scene_release(&scene);
	land(run);
}

static void add_undrawn(struct run *run, const struct tracer *tracer)
{
	const struct tracer_undrawn *u = tracer_undrawn(tracer);

	pthread_mutex_lock(&run->lock);
	run->p->undrawn.targets += u->targets;
	pthread_mutex_unlock(&run->lock);
}

/* Deal with one scene. @return 1, or 0: the device has failed, and this worker with it. *tracer may be NULL afterwards */
static int work_on(struct worker *w, struct tracer **tracer, struct scene *scene)
{
	struct run *run = w->run;
	struct picture *picture = calloc(1, sizeof(*picture));
	enum outcome outcome = STOPPED;

	if (!picture)
		fail(run, err_report(ERR_SYSTEM, NULL, "out of memory"));
	else if (!watch_is_over(run->p->watch))
		outcome = trace(w, *tracer, scene, picture);
	if (outcome == BROKEN) {
		free(picture);
		retire(run, scene);
		return 0;
	}
	scene_release(&scene);
	w->done += outcome == TRACED;
	if (outcome == TRACED && queue_put(&run->pictures, picture))
		return 1;
	if (outcome == LATE) {
		give_up(run, picture);
		add_undrawn(run, *tracer);
		tracer_destroy(tracer);
		if (start_tracer(w, tracer))
			fail(run, ERR_SYSTEM);
	}
	if (picture)
		image_free(&picture->img);
	free(picture);
	land(run);
	return 1;
}

static void *work(void *arg)
{
	struct worker *w = arg;
	struct run *run = w->run;
	struct tracer *tracer = NULL;
	struct scene *scene;
	unsigned left = 1;
	int sound = 1;

	if (start_tracer(w, &tracer))
		fail(run, ERR_SYSTEM);
	while (tracer && sound && (scene = queue_take(&run->scenes)))
		sound = work_on(w, &tracer, scene);
	if (tracer)
		add_undrawn(run, tracer);
	tracer_destroy(&tracer);
	pthread_mutex_lock(&run->lock);
	if (sound)
		left = --run->workers;
	pthread_mutex_unlock(&run->lock);
	if (!left)
		queue_close(&run->scenes); /* nobody would take them */
	return NULL;
}

/* --- Writing ------------------------------------------------------------------------------------------------------- */

static int write_picture(struct run *run, struct picture *picture)
{
	char path[MAX_PATH_BYTES];
	int err = stamp_image(&run->p->stamp, &picture->img);

	/* what was left out on purpose explains nothing that is missing */
	if (!err && run->p->settings->tracer.aov)
		err = image_set_attribute(&picture->img, "relume:aov", "%s", run->p->settings->tracer.aov);

	if (!err)
		err = frame_pattern_expand(run->p->settings->output, picture->frame, path, sizeof(path));
	if (!err)
		err = folder_make_for(path);
	return err ? err : image_write_exr(&picture->img, path);
}

static void *write_all(void *arg)
{
	struct run *run = arg;
	struct picture *picture;

	err_share(&run->writer_said);
	while ((picture = queue_take(&run->pictures))) {
		/* After a signal, what is traced is still written; after a failure it would only fail again. */
		int err = run->err ? run->err : write_picture(run, picture);

		if (!err)
			note(run, picture->frame, "done", picture->seconds);
		else if (!run->err)
			fail(run, err);
		image_free(&picture->img);
		free(picture);
		land(run);
	}
	return NULL;
}

/* --- All together -------------------------------------------------------------------------------------------------- */

/* Packing a file takes about as long as one core takes to trace it: with one writer for two cores, tracing waits now and then. */
static unsigned writer_count(void)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN);

	return cores < 1 ? 1 : cores < MAX_WRITERS ? (unsigned)cores : MAX_WRITERS;
}

/* Every worker has a queue of its own on its device: the first one the device as it was opened, the others share it. */
static int seat_workers(struct run *run, struct worker *workers, size_t n)
{
	struct pipeline *p = run->p;

	for (size_t i = 0; i < n; i++) {
		struct device *dev = p->devices[i / p->jobs];

		workers[i].run = run;
		if (i % p->jobs && device_share(dev, &workers[i].dev))
			return ERR_SYSTEM;
		if (i % p->jobs == 0)
			workers[i].dev = dev;
		workers[i].seat = watch_add(p->watch, workers[i].dev);
		if (workers[i].seat < 0)
			return err_report(ERR_USAGE, NULL, "too many devices and --jobs; at most %d together", WATCH_MAX_SEATS);
	}
	return 0;
}

static int start_and_join(struct run *run, struct worker *workers, size_t n)
{
	pthread_t writers[MAX_WRITERS];
	unsigned n_writers = 0;
	size_t started = 0;
	int err;

	run->workers = (unsigned)n;
	run->idle_bytes = watch_memory();
	while (n_writers < writer_count() && pthread_create(&writers[n_writers], NULL, write_all, run) == 0)
		n_writers++;
	while (n_writers && started < n && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0)
		started++;
	if (started < n)
		fail(run, err_report(ERR_SYSTEM, NULL, "no thread can be started"));
	err = decode(run);
	if (err)
		fail(run, err);
	queue_close(&run->scenes);
	for (size_t i = 0; i < started; i++)
		pthread_join(workers[i].thread, NULL);
	for (struct scene *scene; (scene = queue_take(&run->scenes));)
		scene_release(&scene); /* every worker was gone */
	queue_close(&run->pictures);
	for (unsigned i = 0; i < n_writers; i++)
		pthread_join(writers[i], NULL);
	if (!run->err && run->p->progress->failed)
		run->err = ERR_SYSTEM;
	return run->err;
}

int pipeline_run(struct pipeline *p)
{
	struct run run = { .p = p };
	size_t n = p->n_devices * p->jobs;
	struct worker *workers = calloc(n, sizeof(*workers));
	struct feed feed = { .parent = p->devices[0] };
	int err;

	p->shares = calloc(p->n_devices, sizeof(*p->shares));
	err = workers && p->shares ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	pthread_mutex_init(&run.lock, NULL);
	pthread_cond_init(&run.landed, NULL);
	if (!err)
		err = queue_init(&run.scenes, n, n);
	if (!err)
		err = queue_init(&run.pictures, writer_count(), 0);
	if (!err && n > 1)
		err = grove_create(GROVE_BYTES, &run.grove);
	if (!err)
		err = seat_workers(&run, workers, n);
	feed.grove = run.grove;
	replay_set_supplier(p->replay, feed_supply, &feed);
	if (!err)
		err = start_and_join(&run, workers, n);
	replay_set_supplier(p->replay, NULL, NULL);
	feed_free(&feed);
	grove_destroy(&run.grove);
	for (size_t i = 0; workers && i < n; i++)
		p->shares[i / p->jobs] += workers[i].done;
	for (size_t i = 0; workers && i < n; i++)
		if (i % p->jobs && workers[i].dev)
			device_close(&workers[i].dev);
	queue_free(&run.scenes);
	queue_free(&run.pictures);
	pthread_cond_destroy(&run.landed);
	pthread_mutex_destroy(&run.lock);
	free(workers);
	return err;
}
