#include "verbs/render/watch.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/part.h"
#include "base/progress.h"
#include "verbs/render/guard.h"

#define LOOK_S 0.05
/* from the first signal to the hard end; also for a device that does not come back from a late frame */
#define END_S 20.0

struct seat {
	struct device *dev;
	uint64_t frame;
	double start_s; /* 0: idle */
	int late;
};

struct watch {
	pthread_t thread;
	pthread_mutex_t lock;
	struct seat seats[WATCH_MAX_SEATS];
	int n_seats;
	const struct guard *guard;
	struct watch_limits limits;
	double signal_s;
	unsigned direct, passed_on; /* signals that came here, and that the parent had and passed on: mostly the same ones */
	sigset_t signals, before;
	atomic_int signal, over, done;
};

uint64_t watch_memory(void)
{
	unsigned long long all, resident = 0;
	FILE *file = fopen("/proc/self/statm", "r");

	if (file) {
		if (fscanf(file, "%llu %llu", &all, &resident) != 2)
			resident = 0;
		fclose(file);
	}
	return resident * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void end_now(int code)
{
	part_drop_all();
	_exit(code);
}

static void break_off_all(struct watch *w)
{
	pthread_mutex_lock(&w->lock);
	for (int i = 0; i < w->n_seats; i++)
		device_interrupt(w->seats[i].dev);
	pthread_mutex_unlock(&w->lock);
}

static void take_signal(struct watch *w, const siginfo_t *info)
{
	const unsigned before = w->direct > w->passed_on ? w->direct : w->passed_on;
	const int number = info->si_signo;

	*(guard_is_passed_on(w->guard, info->si_code) ? &w->passed_on : &w->direct) += 1;
	if (w->direct <= before && w->passed_on <= before)
		return;
	if (atomic_load(&w->signal))
		end_now(128 + number);
	w->signal_s = progress_clock_s();
	atomic_store(&w->signal, number);
	atomic_store(&w->over, 1);
	break_off_all(w);
}

static void look_at_times(struct watch *w)
{
	double now = progress_clock_s();

	pthread_mutex_lock(&w->lock);
	for (int i = 0; i < w->n_seats; i++) {
		struct seat *s = &w->seats[i];

		if (s->start_s == 0 || now - s->start_s < w->limits.frame_s)
			continue;
		if (s->late && now - s->start_s > w->limits.frame_s + END_S) {
			if (!w->guard->attempt || !fault_hang())
				err_report(ERR_SYSTEM, NULL, "frame %llu: the device does not come back; the run ends",
				           (unsigned long long)s->frame);
			end_now(-ERR_SYSTEM);
		}
		s->late = 1;
		device_interrupt(s->dev);
	}
	pthread_mutex_unlock(&w->lock);
}

/* Running fewer frames at once does not help a frame that alone needs too much. */
static void look_at_memory(struct watch *w)
{
	uint64_t frame = 0, now = watch_memory();
	int n = 0;

	if (now <= w->limits.memory_bytes)
		return;
	pthread_mutex_lock(&w->lock);
	for (int i = 0; i < w->n_seats; i++)
		if (w->seats[i].start_s != 0) {
			frame = w->seats[i].frame;
			n++;
		}
	pthread_mutex_unlock(&w->lock);
	if (n != 1)
		return;
	err_report(ERR_SYSTEM, NULL,
	           "frame %llu: takes %llu MiB, more than --limit-memory allows (%llu MiB); the run ends",
	           (unsigned long long)frame, (unsigned long long)(now >> 20),
	           (unsigned long long)(w->limits.memory_bytes >> 20));
	end_now(-ERR_SYSTEM);
}

/* From one look to the next: so short that a frame is given up when its time is over, and not much later. */
static struct timespec interval(const struct watch *w)
{
	const double part = w->limits.frame_s > 0 ? w->limits.frame_s / 4 : LOOK_S, least = 1e-3;

	return (struct timespec){ 0, (long)(1e9 * (part > LOOK_S ? LOOK_S : part < least ? least : part)) };
}

static void *look(void *arg)
{
	struct watch *w = arg;
	const struct timespec wait = interval(w);
	double before_s = progress_clock_s();

	while (!atomic_load(&w->done)) {
		siginfo_t info;
		int number = sigtimedwait(&w->signals, &info, &wait);
		const double now_s = progress_clock_s(), passed_s = now_s - before_s;

		before_s = now_s;

		if (atomic_load(&w->done))
			break;
		if (number > 0)
			take_signal(w, &info);
		if (atomic_load(&w->signal) && progress_clock_s() - w->signal_s > END_S)
			end_now(128 + atomic_load(&w->signal));
		if (w->limits.driver_s > 0 && fault_look(w->limits.driver_s, passed_s < 2 * LOOK_S ? passed_s : 2 * LOOK_S))
			end_now(-ERR_SYSTEM);
		if (w->limits.frame_s > 0)
			look_at_times(w);
		if (w->limits.memory_bytes)
			look_at_memory(w);
	}
	return NULL;
}

int watch_start(struct watch **out, const struct guard *guard, const struct watch_limits *limits)
{
	struct watch *w = calloc(1, sizeof(*w));

	if (!w)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	w->guard = guard;
	w->limits = *limits;
	pthread_mutex_init(&w->lock, NULL);
	sigemptyset(&w->signals);
	sigaddset(&w->signals, SIGINT);
	sigaddset(&w->signals, SIGTERM);
	pthread_sigmask(SIG_BLOCK, &w->signals, &w->before);
	signal(SIGXFSZ, SIG_IGN); /* a file that grows too large is an error of that file only */
	signal(SIGPIPE, SIG_IGN); /* nobody need read the progress */
	if (pthread_create(&w->thread, NULL, look, w) != 0) {
		pthread_sigmask(SIG_SETMASK, &w->before, NULL);
		pthread_mutex_destroy(&w->lock);
		free(w);
		return err_report(ERR_SYSTEM, NULL, "no thread can be started");
	}
	*out = w;
	return 0;
}

void watch_stop(struct watch **w)
{
	const struct timespec none = { 0, 0 };

	if (!*w)
		return;
	atomic_store(&(*w)->done, 1);
	/* NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread): blocked in all threads, this one waits for it */
	pthread_kill((*w)->thread, SIGTERM); /* wakes it, and means nothing to it now */
	pthread_join((*w)->thread, NULL);
	while (sigtimedwait(&(*w)->signals, NULL, &none) > 0)
		;
	pthread_sigmask(SIG_SETMASK, &(*w)->before, NULL);
	pthread_mutex_destroy(&(*w)->lock);
	free(*w);
	*w = NULL;
}

int watch_signal(const struct watch *w)
{
	return atomic_load(&w->signal);
}

int watch_is_over(const struct watch *w)
{
	return atomic_load(&w->over);
}

void watch_give_up(struct watch *w)
{
	atomic_store(&w->over, 1);
	break_off_all(w);
}

int watch_add(struct watch *w, struct device *dev)
{
	int seat = -1;

	pthread_mutex_lock(&w->lock);
	if (w->n_seats < WATCH_MAX_SEATS) {
		seat = w->n_seats++;
		w->seats[seat] = (struct seat){ .dev = dev };
	}
	pthread_mutex_unlock(&w->lock);
	if (atomic_load(&w->over))
		device_interrupt(dev);
	return seat;
}

void watch_begin(struct watch *w, int seat, uint64_t frame)
{
	pthread_mutex_lock(&w->lock);
	w->seats[seat].frame = frame;
	w->seats[seat].late = 0;
	w->seats[seat].start_s = progress_clock_s();
	pthread_mutex_unlock(&w->lock);
}

int watch_end(struct watch *w, int seat)
{
	int late;

	pthread_mutex_lock(&w->lock);
	late = w->seats[seat].late;
	w->seats[seat].start_s = 0;
	w->seats[seat].late = 0;
	if (late && !atomic_load(&w->over))
		device_resume(w->seats[seat].dev);
	pthread_mutex_unlock(&w->lock);
	return late;
}
