#include "tracer/accel/forks.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

#define MAX_THREADS 64

int forks_init(struct forks *forks, size_t task_bytes, size_t room)
{
	memset(forks, 0, sizeof(*forks));
	forks->tasks = malloc(task_bytes * room);
	if (!forks->tasks)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	forks->task_bytes = task_bytes;
	forks->room = room;
	pthread_mutex_init(&forks->lock, NULL);
	pthread_cond_init(&forks->changed, NULL);
	return 0;
}

void forks_free(struct forks *forks)
{
	if (!forks->tasks)
		return;
	free(forks->tasks);
	forks->tasks = NULL;
	pthread_mutex_destroy(&forks->lock);
	pthread_cond_destroy(&forks->changed);
}

void forks_add(struct forks *forks, const void *task)
{
	pthread_mutex_lock(&forks->lock);
	assert(forks->waiting < forks->room);
	memcpy(forks->tasks + (forks->first + forks->waiting) % forks->room * forks->task_bytes, task, forks->task_bytes);
	forks->waiting++;
	pthread_cond_signal(&forks->changed);
	pthread_mutex_unlock(&forks->lock);
}

static void *work(void *arg)
{
	struct forks *forks = arg;
	char task[forks->task_bytes] __attribute__((aligned(64)));

	pthread_mutex_lock(&forks->lock);
	for (;;) {
		while (!forks->waiting && forks->busy)
			pthread_cond_wait(&forks->changed, &forks->lock);
		if (!forks->waiting)
			break;
		memcpy(task, forks->tasks + forks->first * forks->task_bytes, forks->task_bytes);
		forks->first = (forks->first + 1) % forks->room;
		forks->waiting--;
		forks->busy++;
		pthread_mutex_unlock(&forks->lock);
		forks->run(forks->arg, task);
		pthread_mutex_lock(&forks->lock);
		forks->busy--;
	}
	pthread_cond_broadcast(&forks->changed);
	pthread_mutex_unlock(&forks->lock);
	return NULL;
}

void forks_run(struct forks *forks, unsigned threads, forks_do *run, void *arg)
{
	pthread_t others[MAX_THREADS];
	unsigned started = 0;

	if (threads == 0) { /* counting processors reads a file: avoid it for small meshes */
		const long processors = sysconf(_SC_NPROCESSORS_ONLN);

		threads = processors < 1 ? 1 : (unsigned)processors;
	}
	forks->run = run;
	forks->arg = arg;
	for (unsigned i = 1; i < threads && i < MAX_THREADS; i++)
		started += pthread_create(&others[started], NULL, work, forks) == 0;
	work(forks);
	while (started)
		pthread_join(others[--started], NULL);
}
