#include "verbs/render/pipeline.h"

#include <limits.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "look/apply/apply.h"
#include "verbs/render/decode.h"
#include "verbs/render/look.h"
#include "verbs/render/supply.h"
#include "verbs/render/write.h"

#define MAX_WRITERS 8

static void tell_replay(void *user, uint64_t frame, uint64_t played, uint64_t of, const char *why)
{
	struct pipeline_state *state = user;

	pthread_mutex_lock(&state->lock);
	progress_replay(&state->p->carried->progress, frame, played, of, why);
	pthread_mutex_unlock(&state->lock);
}

/* A core packs a file in about the time it traces one: with one writer for two cores, tracing waits now and then. */
static unsigned writer_count(void)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN);

	return cores < 1 ? 1 : cores < MAX_WRITERS ? (unsigned)cores : MAX_WRITERS;
}

/* Every worker has a queue of its own on its device: the first uses the device as it was opened, the others share
 * it. */
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
	while (n_writers < writer_count() && pthread_create(&writers[n_writers], NULL, pipeline_write, state) == 0)
		n_writers++;
	err = n_writers ? pipeline_decode(state) : err_report(ERR_SYSTEM, NULL, "no thread can be started");
	if (err)
		pipeline_fail(state, err);
	queue_close(&state->shots);
	for (size_t i = 0; i < state->n_started; i++)
		pthread_join(workers[i].thread, NULL);
	for (struct shot *shot; (shot = queue_take(&state->shots));)
		shot_drop(&shot); /* every worker was gone */
	shot_leave_scene(&state->held);
	queue_close(&state->pictures);
	for (unsigned i = 0; i < n_writers; i++)
		pthread_join(writers[i], NULL);
	alike_end(&state->alike);
	if (!state->err && state->p->carried->progress.failed)
		state->err = ERR_SYSTEM;
	return state->err;
}

/* In the cache: pixels of frames that others begin with. What hooks of a user draw is theirs. */
static int keep_pixels(struct pipeline *p)
{
	const struct settings *s = p->settings;
	char folder[PATH_MAX];

	if (s->no_cache || s->hook || (!s->cache && !folder_cached("pixels", folder, sizeof(folder))))
		return 0;
	return replay_keep_pixels(p->replay, s->cache ? s->cache : folder, device_name(p->devices[0]));
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
	if (!err)
		err = queue_init(&state.shots, n, n);
	if (!err)
		err = queue_init(&state.pictures, writer_count(), 0);
	if (!err && n > 1)
		err = blas_cache_create(BLAS_CACHE_BYTES, &state.cache);
	if (!err)
		err = seat_workers(&state, workers, n);
	supply.cache = state.cache;
	supply.number = &state.decoded;
	replay_set_supplier(p->replay, supply_picture, &supply);
	if (!settings_resize(p->settings) && !settings_mixes(p->settings))
		replay_leave_starts(p->replay);
	if (!err)
		err = keep_pixels(p);
	replay_set_tell(p->replay, tell_replay, &state);
	if (!look_spares(p->settings->look))
		replay_keep_targets(p->replay);
	if (!err && p->settings->tracer.mode != TRACER_GL)
		err = look_fetch_unseen(p->replay, p->settings->look);
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
	pthread_cond_destroy(&state.landed);
	pthread_mutex_destroy(&state.lock);
	free(workers);
	return err;
}
