/*
 * Progress of a run over frames: a bar with rate and time left where standard error is a terminal, one plain line per
 * frame elsewhere (farm managers parse "VERB frame N, DONE of TOTAL: TEXT"), or JSON, one object a line, on standard
 * output:
 *
 *     {"event": "begin", "verb": "rendered", "total": 500}
 *     {"event": "start", "frame": 12, "seconds": 0.05}
 *     {"event": "replay", "frame": 12, "played": 7, "of": 12}
 *     {"event": "sample", "frame": 12, "done": 3, "of": 64}
 *     {"event": "frame", "frame": 12, "state": "done", "seconds": 0.123, "done": 3, "total": 500}
 *     {"event": "end", "done": 500, "seconds": 61.2, "peak_memory_bytes": 536870912}
 *
 * A state is "done", "skipped" (already there) or "failed"; total is 0 if unknown. Once a second, "replay" reports how
 * many of the frames that frame 12 depends on or follows have been played, and "sample" how many of its samples are
 * done; `of` is 0 if time or noise decides.
 */
#pragma once

#include <stdint.h>

enum progress_style { PROGRESS_AUTO, PROGRESS_BAR, PROGRESS_LINES, PROGRESS_JSON, PROGRESS_NONE };

#define PROGRESS_SLOWEST 3

struct progress {
	const char *verb;   /* "rendered", "scored"; borrowed */
	uint64_t total;     /* frames in all; 0 if unknown */
	uint64_t done, skipped, failed; /* done: includes skipped and failed */
	enum progress_style style;      /* never AUTO once begun */
	double start_s;
	uint64_t replayed;       /* progress_replay's last frame */
	const char *why;         /* why it needed others; borrowed */
	double told_s;           /* when both were last reported, or first passed */
	double first_s;          /* when the first frame that was not skipped was done; 0: none */
	double sampled_s;        /* when progress_sample last reported, or was first called; 0: never */
	struct { uint64_t frame; double seconds; } slowest[PROGRESS_SLOWEST]; /* slowest first; seconds 0: none */
};

/** Start a run of `total` frames: a bar or lines. */
void progress_begin(struct progress *p, const char *verb, uint64_t total);

/** The same in a given style; PROGRESS_AUTO picks bar or lines. */
void progress_begin_style(struct progress *p, const char *verb, uint64_t total, enum progress_style style);

/** Continue in another process, with the progress in memory that both share. */
void progress_go_on(const struct progress *p);

/** The style of that name ("bar", "lines", "json", "none", "auto"), or -1. */
int progress_style_of(const char *word);

/** One frame is done. `text` ("0.12 s, 2 views") appears on plain lines only. */
void progress_step(struct progress *p, uint64_t frame, const char *text);

/** Work on the first frame begins, `seconds` after the command started. Printed in JSON only. */
void progress_start(const struct progress *p, uint64_t frame, double seconds);

/**
 * Report that `played` of the `of` earlier frames replayed for a frame, but not rendered, are done. A bar shows it at
 * once, lines every ten seconds.
 * @param why  why the frame needs them, borrowed until the next call; NULL: they are only on the way
 */
void progress_replay(struct progress *p, uint64_t frame, uint64_t played, uint64_t of, const char *why);

/**
 * Report that `done` samples of the current frame are finished. A bar shows it at once, lines every ten seconds.
 * @param of  total number of samples; 0: not known in advance
 */
void progress_sample(struct progress *p, uint64_t frame, uint32_t done, uint32_t of);

/** As progress_step, with a state ("done", "skipped", "failed") and the time the frame took. */
void progress_frame(struct progress *p, uint64_t frame, const char *state, double seconds);

/** Print the totals of the run: frames, rate, slowest frames, peak memory. Call after progress_end. */
void progress_summary(const struct progress *p);

/** Clear the bar. Prints nothing itself. */
void progress_end(struct progress *p);

/** Seconds of a monotonic clock; only differences have a meaning. */
double progress_clock_s(void);
/** Seconds of processor time that this process has taken, all threads together. */
double progress_processor_s(void);
