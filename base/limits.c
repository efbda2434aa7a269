#include "base/limits.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/progress.h"

#define LOOK_MS 50
#define STACK_BYTES ((size_t)256 << 10)

static struct {
	const char *recording;
	struct limits limits;
} watched;

struct limits limits_of_reader(uint64_t recording_bytes)
{
	return (struct limits){ ((uint64_t)2 << 30) + 256 * recording_bytes, 600 + (double)recording_bytes / 4096 };
}

struct limits limits_of_tracer(uint64_t recording_bytes)
{
	const uint64_t by_size = ((uint64_t)4 << 30) + 256 * recording_bytes;
	const uint64_t machine = (uint64_t)sysconf(_SC_PHYS_PAGES) * (uint64_t)sysconf(_SC_PAGESIZE) / 10 * 9;

	return (struct limits){ by_size > machine ? by_size : machine, 0 };
}

static uint64_t memory_used(void)
{
	unsigned long long all, resident, shared;
	FILE *file = fopen("/proc/self/statm", "re");
	int n = file ? fscanf(file, "%llu %llu %llu", &all, &resident, &shared) : 0;

	if (file)
		fclose(file);
	return n == 3 && resident > shared ? (resident - shared) * (uint64_t)sysconf(_SC_PAGESIZE) : 0;
}

static void end_now(void)
{
	part_drop_all();
	folder_drop_early();
	_exit(-ERR_SYSTEM);
}

static void *look(void *unused)
{
	const struct limits *l = &watched.limits;
	const struct timespec wait = { 0, LOOK_MS * 1000000L };

	for (;;) {
		if (memory_used() > l->memory_bytes) {
			err_report(ERR_SYSTEM, watched.recording,
			           "asks for more than %llu MiB of memory, the limit for a recording of its size; "
			           "--no-sandbox lifts it",
			           (unsigned long long)(l->memory_bytes >> 20));
			end_now();
		}
		if (l->processor_s > 0 && progress_processor_s() > l->processor_s) {
			err_report(ERR_SYSTEM, watched.recording,
			           "takes more than %.0f s of processor time, the limit for a recording of its size; "
			           "--no-sandbox lifts it",
			           l->processor_s);
			end_now();
		}
		nanosleep(&wait, NULL);
	}
	return unused;
}

void limits_begin(const char *recording, const struct limits *limits)
{
	sigset_t all, before;
	pthread_attr_t attr;
	pthread_t thread;

	watched.recording = recording;
	watched.limits = *limits;
	sigfillset(&all);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	if (pthread_attr_init(&attr) == 0) {
		pthread_attr_setstacksize(&attr, STACK_BYTES);
		pthread_attr_setdetachstate(&attr, PTHREAD_CREATE_DETACHED);
		pthread_create(&thread, &attr, look, NULL);
		pthread_attr_destroy(&attr);
	}
	pthread_sigmask(SIG_SETMASK, &before, NULL);
}
