/* Makes the time of day jump by a day, forwards or backwards, at every tenth query (LD_PRELOAD; tests/show/soak.py).
 * The monotonic clock is unaffected. */
#include <dlfcn.h>
#include <stddef.h>
#include <sys/time.h>
#include <time.h>

#define EVERY 10
#define JUMP_S 86400

static time_t step(void)
{
	static int asked;
	const int n = __atomic_fetch_add(&asked, 1, __ATOMIC_RELAXED) / EVERY % 3;

	return n == 0 ? 0 : n == 1 ? JUMP_S : -JUMP_S;
}

int clock_gettime(clockid_t clock, struct timespec *out)
{
	static int (*real)(clockid_t, struct timespec *);
	int rc;

	if (!real)
		*(void **)&real = dlsym(RTLD_NEXT, "clock_gettime");
	rc = real(clock, out);
	if (rc == 0 && clock == CLOCK_REALTIME)
		out->tv_sec += step();
	return rc;
}

time_t time(time_t *out)
{
	struct timespec now;

	clock_gettime(CLOCK_REALTIME, &now);
	if (out)
		*out = now.tv_sec;
	return now.tv_sec;
}

int gettimeofday(struct timeval *restrict out, void *restrict zone)
{
	struct timespec now;

	(void)zone;
	clock_gettime(CLOCK_REALTIME, &now);
	out->tv_sec = now.tv_sec;
	out->tv_usec = now.tv_nsec / 1000;
	return 0;
}
