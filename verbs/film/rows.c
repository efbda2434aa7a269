#include "verbs/film/rows.h"

#include <pthread.h>
#include <unistd.h>

#define MOST_THREADS 16u

struct rows {
	void (*run)(const void *user, uint32_t y);
	const void *user;
	uint32_t first, step, end;
};

static void *run_rows(void *arg)
{
	const struct rows *r = arg;

	for (uint32_t y = r->first; y < r->end; y += r->step)
		r->run(r->user, y);
	return NULL;
}

void rows_each(uint32_t height, void (*run)(const void *user, uint32_t y), const void *user)
{
	const long cores = sysconf(_SC_NPROCESSORS_ONLN);
	const uint32_t n = cores < 1 ? 1 : cores > (long)MOST_THREADS ? MOST_THREADS : (uint32_t)cores;
	pthread_t threads[MOST_THREADS];
	struct rows rows[MOST_THREADS];
	int started[MOST_THREADS] = { 0 };

	for (uint32_t i = 0; i < n; i++)
		rows[i] = (struct rows){ run, user, i, n, height };
	for (uint32_t i = 1; i < n; i++)
		started[i] = pthread_create(&threads[i], NULL, run_rows, &rows[i]) == 0;
	for (uint32_t i = 0; i < n; i++)
		if (!started[i])
			run_rows(&rows[i]);
	for (uint32_t i = 1; i < n; i++)
		if (started[i])
			pthread_join(threads[i], NULL);
}
