/*
 * Preloaded before the recorder by tests/show/overhead.py: measures a program that never ends, over SHIM_FRAMES frames
 * after the first hundred, prints milliseconds per frame of wall time and processor time, and ends the program.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WARM_UP = 100 };

static double clock_ms(clockid_t clock)
{
	struct timespec t;

	clock_gettime(clock, &t);
	return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

void glXSwapBuffers(void *display, unsigned long drawable)
{
	static void (*swap)(void *, unsigned long);
	static double start, used;
	static long frames;
	const char *wanted = getenv("SHIM_FRAMES");

	if (!swap)
		swap = (void (*)(void *, unsigned long))dlsym(RTLD_NEXT, "glXSwapBuffers");
	swap(display, drawable);
	if (++frames == WARM_UP) {
		start = clock_ms(CLOCK_MONOTONIC);
		used = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
	}
	if (!wanted || frames < WARM_UP + atol(wanted))
		return;
	printf("%.4f %.4f\n", (clock_ms(CLOCK_MONOTONIC) - start) / (double)(frames - WARM_UP),
	       (clock_ms(CLOCK_PROCESS_CPUTIME_ID) - used) / (double)(frames - WARM_UP));
	exit(0);
}
