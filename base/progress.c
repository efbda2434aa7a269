#define _POSIX_C_SOURCE 200809L
#include "base/progress.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double progress_clock_s(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_begin(struct progress *p, const char *verb, uint64_t total)
{
	*p = (struct progress){
		.verb = verb, .total = total, .terminal = isatty(STDERR_FILENO), .start_s = progress_clock_s(),
	};
}

static void draw_bar(const struct progress *p, uint64_t frame)
{
	enum { WIDTH = 30 };
	double elapsed = progress_clock_s() - p->start_s;
	double rate = elapsed > 0 ? (double)p->done / elapsed : 0;
	char bar[WIDTH + 1];

	if (p->total == 0) {
		fprintf(stderr, "\r\033[K%s frame %" PRIu64 "  %.1f frames/s", p->verb, frame, rate);
		return;
	}
	uint64_t done = p->done < p->total ? p->done : p->total;
	size_t filled = (size_t)(WIDTH * done / p->total);

	memset(bar, '.', WIDTH);
	memset(bar, '#', filled);
	bar[WIDTH] = '\0';
	fprintf(stderr, "\r\033[K%s [%s] %" PRIu64 "/%" PRIu64 "  %.1f frames/s  %.0f s left", p->verb, bar, done,
	        p->total, rate, rate > 0 ? (double)(p->total - done) / rate : 0.0);
}

void progress_step(struct progress *p, uint64_t frame, const char *text)
{
	p->done++;
	if (p->terminal)
		draw_bar(p, frame);
	else if (p->total)
		fprintf(stderr, "%s frame %" PRIu64 ", %" PRIu64 " of %" PRIu64 ": %s\n", p->verb, frame, p->done,
		        p->total, text);
	else
		fprintf(stderr, "%s frame %" PRIu64 ": %s\n", p->verb, frame, text);
}

void progress_end(struct progress *p)
{
	if (p->terminal)
		fputs("\r\033[K", stderr);
}
