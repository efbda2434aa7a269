#define _POSIX_C_SOURCE 200809L
#include "base/progress.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/plural.h"

static double seconds_of(clockid_t clock)
{
	struct timespec now;

	clock_gettime(clock, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double progress_clock_s(void)
{
	return seconds_of(CLOCK_MONOTONIC);
}

double progress_processor_s(void)
{
	return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

/* Peak memory of this process so far, in bytes. */
static uint64_t progress_peak_memory(void)
{
	struct rusage usage;

	return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

int progress_style_of(const char *word)
{
	static const char *const words[] = { "auto", "bar", "lines", "json", "none" };

	for (int i = 0; i < (int)(sizeof(words) / sizeof(words[0])); i++)
		if (strcmp(word, words[i]) == 0)
			return i;
	return -1;
}

void progress_begin_style(struct progress *p, const char *verb, uint64_t total, enum progress_style style)
{
	if (style == PROGRESS_AUTO)
		style = isatty(STDERR_FILENO) ? PROGRESS_BAR : PROGRESS_LINES;
	*p = (struct progress){
		.verb = verb, .total = total, .style = style, .start_s = progress_clock_s(), .replayed = UINT64_MAX
	};
	err_clear_bar(style == PROGRESS_BAR);
	if (style == PROGRESS_JSON) {
		printf("{\"event\": \"begin\", \"verb\": \"%s\", \"total\": %" PRIu64 "}\n", verb, total);
		fflush(stdout);
	}
}

void progress_go_on(const struct progress *p)
{
	err_clear_bar(p->style == PROGRESS_BAR);
}

void progress_begin(struct progress *p, const char *verb, uint64_t total)
{
	progress_begin_style(p, verb, total, PROGRESS_AUTO);
}

enum { WIDTH = 30 };

static void fill_bar(char bar[WIDTH + 1], uint64_t done, uint64_t total)
{
	const size_t filled = (size_t)(WIDTH * done / total);

	memset(bar, '.', WIDTH);
	memset(bar, '#', filled);
	bar[WIDTH] = '\0';
}

/*
 * Seconds left, estimated from the frames after the first, which waited for kernels. Frames of several workers arrive
 * together, so wait a second before estimating.
 * @return below 0: not known yet
 */
static double seconds_left(const struct progress *p)
{
	const double since_s = progress_clock_s() - p->first_s;
	const uint64_t worked = p->done - p->skipped;

	if (p->done >= p->total)
		return 0;
	return p->first_s > 0 && worked > 1 && since_s >= 1 ?
	               since_s / (double)(worked - 1) * (double)(p->total - p->done) :
	               -1;
}

static void draw_bar(const struct progress *p, uint64_t frame)
{
	double elapsed = progress_clock_s() - p->start_s, left = seconds_left(p);
	/* Skipped frames cost next to nothing; estimate from those that were rendered. */
	double rate = elapsed > 0 ? (double)(p->done - p->skipped) / elapsed : 0;
	char bar[WIDTH + 1];

	if (p->total == 0) {
		fprintf(stderr, "\r\033[K%s frame %" PRIu64 "  %.1f frames/s", p->verb, frame, rate);
		return;
	}
	uint64_t done = p->done < p->total ? p->done : p->total;

	fill_bar(bar, done, p->total);
	fprintf(stderr, "\r\033[K%s [%s] %" PRIu64 "/%" PRIu64 "  %.1f frames/s", p->verb, bar, done, p->total, rate);
	if (left >= 0)
		fprintf(stderr, "  %.0f s left", left);
}

void progress_step(struct progress *p, uint64_t frame, const char *text)
{
	p->done++;
	if (p->first_s == 0 && p->done > p->skipped)
		p->first_s = progress_clock_s();
	if (p->style == PROGRESS_BAR)
		draw_bar(p, frame);
	else if (p->style == PROGRESS_LINES && p->total)
		fprintf(stderr, "%s frame %" PRIu64 ", %" PRIu64 " of %" PRIu64 ": %s\n", p->verb, frame, p->done,
		        p->total, text);
	else if (p->style == PROGRESS_LINES)
		fprintf(stderr, "%s frame %" PRIu64 ": %s\n", p->verb, frame, text);
}

void progress_start(const struct progress *p, uint64_t frame, double seconds)
{
	if (p->style != PROGRESS_JSON)
		return;
	printf("{\"event\": \"start\", \"frame\": %" PRIu64 ", \"seconds\": %.4f}\n", frame, seconds);
	fflush(stdout);
}

/* Seconds between reports about an unfinished frame. */
static double telling_interval_s(const struct progress *p)
{
	return p->style == PROGRESS_BAR ? 0.1 : p->style == PROGRESS_JSON ? 1 : 10;
}

void progress_replay(struct progress *p, uint64_t frame, uint64_t played, uint64_t of, const char *why)
{
	const double now = progress_clock_s();
	char bar[WIDTH + 1];

	if (p->replayed != frame || p->why != why) {
		p->replayed = frame;
		p->why = why;
		p->told_s = why && p->style == PROGRESS_BAR ? 0 : now;
	}
	if (of == 0 || now - p->told_s < telling_interval_s(p) || p->style == PROGRESS_NONE)
		return;
	p->told_s = now;
	if (p->style == PROGRESS_BAR) {
		fill_bar(bar, played < of ? played : of, of);
		fprintf(stderr, "\r\033[Kreplaying [%s] %" PRIu64 "/%" PRIu64 "  before frame %" PRIu64 "%s%s", bar,
		        played, of, frame, why ? ": " : "", why ? why : "");
	} else if (p->style == PROGRESS_JSON) {
		printf("{\"event\": \"replay\", \"frame\": %" PRIu64 ", \"played\": %" PRIu64 ", \"of\": %" PRIu64
		       "}\n",
		       frame, played, of);
		fflush(stdout);
	} else {
		fprintf(stderr, "replayed %" PRIu64 " of %" PRIu64 " frames before frame %" PRIu64 "%s%s\n", played, of,
		        frame, why ? ": " : "", why ? why : "");
	}
}

void progress_sample(struct progress *p, uint64_t frame, uint32_t done, uint32_t of)
{
	const double now = progress_clock_s();
	char count[32];

	if (p->sampled_s == 0)
		p->sampled_s = now;
	if (now - p->sampled_s < telling_interval_s(p) || p->style == PROGRESS_NONE)
		return;
	p->sampled_s = now;
	snprintf(count, sizeof(count), of ? "%" PRIu32 " of %" PRIu32 : "%" PRIu32, done, of);
	if (p->style == PROGRESS_BAR) {
		draw_bar(p, frame);
		fprintf(stderr, "  frame %" PRIu64 ": sample %s", frame, count);
	} else if (p->style == PROGRESS_JSON) {
		printf("{\"event\": \"sample\", \"frame\": %" PRIu64 ", \"done\": %" PRIu32 ", \"of\": %" PRIu32 "}\n",
		       frame, done, of);
		fflush(stdout);
	} else {
		fprintf(stderr, "frame %" PRIu64 ": sample %s\n", frame, count);
	}
}

static void note_slow(struct progress *p, uint64_t frame, double seconds)
{
	size_t at = PROGRESS_SLOWEST;

	while (at > 0 && p->slowest[at - 1].seconds < seconds)
		at--;
	if (at == PROGRESS_SLOWEST)
		return;
	memmove(&p->slowest[at + 1], &p->slowest[at], (PROGRESS_SLOWEST - 1 - at) * sizeof(p->slowest[0]));
	p->slowest[at].frame = frame;
	p->slowest[at].seconds = seconds;
}

void progress_frame(struct progress *p, uint64_t frame, const char *state, double seconds)
{
	char text[64];
	int skipped = strcmp(state, "skipped") == 0, failed = strcmp(state, "failed") == 0;

	snprintf(text, sizeof(text), "%.2f s", seconds);
	p->skipped += (uint64_t)skipped;
	p->failed += (uint64_t)failed;
	if (!skipped && !failed)
		note_slow(p, frame, seconds);
	progress_step(p, frame, skipped ? "there already" : failed ? "failed" : text);
	if (p->style == PROGRESS_JSON) {
		printf("{\"event\": \"frame\", \"frame\": %" PRIu64 ", \"state\": \"%s\", \"seconds\": %.3f, \"done\": %"
		       PRIu64 ", \"total\": %" PRIu64 "}\n", frame, state, seconds, p->done, p->total);
		fflush(stdout);
	}
}

void progress_end(struct progress *p)
{
	if (p->style == PROGRESS_BAR)
		fputs("\r\033[K", stderr);
	err_clear_bar(0);
	if (p->style == PROGRESS_JSON) {
		printf("{\"event\": \"end\", \"done\": %" PRIu64 ", \"skipped\": %" PRIu64 ", \"failed\": %" PRIu64
		       ", \"seconds\": %.3f, \"peak_memory_bytes\": %" PRIu64 "}\n", p->done, p->skipped, p->failed,
		       progress_clock_s() - p->start_s, progress_peak_memory());
		fflush(stdout);
	}
}

void progress_summary(const struct progress *p)
{
	double elapsed = progress_clock_s() - p->start_s;
	uint64_t worked = p->done - p->skipped - p->failed;
	char text[512];
	size_t n = 0;

	if (p->style == PROGRESS_JSON || p->style == PROGRESS_NONE)
		return;
	n += (size_t)snprintf(text + n, sizeof(text) - n, "%s %" PRIu64 " frame%s in %.1f s (%.2f frames/s)", p->verb, worked,
	                      plural(worked), elapsed, elapsed > 0 ? (double)worked / elapsed : 0.0);
	if (p->skipped)
		n += (size_t)snprintf(text + n, sizeof(text) - n, ", %" PRIu64 " were there already", p->skipped);
	if (p->failed)
		n += (size_t)snprintf(text + n, sizeof(text) - n, ", %" PRIu64 " failed", p->failed);
	n += (size_t)snprintf(text + n, sizeof(text) - n, "; peak memory %" PRIu64 " MiB", progress_peak_memory() >> 20);
	for (size_t i = 0; i < PROGRESS_SLOWEST && p->slowest[i].seconds > 0; i++)
		n += (size_t)snprintf(text + n, sizeof(text) - n, "%s frame %" PRIu64 " %.2f s", i ? "," : "; slowest:",
		                      p->slowest[i].frame, p->slowest[i].seconds);
	fprintf(stderr, "%s\n", text);
}
