/*
 * Progress of a run over frames: a bar with rate and time left where standard error is a terminal, one plain line per
 * frame elsewhere (farm managers parse "VERB frame N, DONE of TOTAL: TEXT"), or JSON, one object a line, on standard output:
 *
 *     {"event": "begin", "verb": "rendered", "total": 500}
 *     {"event": "start", "frame": 12, "seconds": 0.05}
 *     {"event": "replay", "frame": 12, "played": 7, "of": 12}
 *     {"event": "sample", "frame": 12, "done": 3, "of": 64}
 *     {"event": "frame", "frame": 12, "state": "done", "seconds": 0.123, "done": 3, "total": 500}
 *     {"event": "end", "done": 500, "seconds": 61.2, "peak_memory_bytes": 536870912}
 *
 * A state is "done", "skipped" (there already) or "failed"; total is 0 where it is not known. "replay" tells every second how many frames have
 * been played that frame 12 depends on or follows, "sample" how many samples of it are there; `of` is 0 where time or noise decides.
 */
#pragma once

#include <stdint.h>

enum progress_style { PROGRESS_AUTO, PROGRESS_BAR, PROGRESS_LINES, PROGRESS_JSON, PROGRESS_NONE };

#define PROGRESS_SLOWEST 3

struct progress {
	const char *verb;   /* "rendered", "scored"; borrowed */
	uint64_t total;     /* frames in all; 0 where it is not known */
	uint64_t done, skipped, failed; /* done: includes skipped and failed */
	enum progress_style style;      /* never AUTO once begun */
	double start_s;
	uint64_t replayed;       /* progress_replay's last frame */
	const char *why;         /* and what it needed; borrowed */
	double told_s;           /* when it has told of both, or was called for them first */
	double first_s;          /* when the first frame was done that was worked on; 0: none */
	double sampled_s;        /* when progress_sample has told last, or was called first; 0: never */
	struct { uint64_t frame; double seconds; } slowest[PROGRESS_SLOWEST]; /* slowest first; seconds 0: none */
};

/** Start a run of `total` frames: a bar or lines. */
void progress_begin(struct progress *p, const char *verb, uint64_t total);

/** The same in a style asked for; PROGRESS_AUTO picks bar or lines. */
void progress_begin_style(struct progress *p, const char *verb, uint64_t total, enum progress_style style);

/** Go on in another process, which finds the progress in memory that both share. */
void progress_go_on(const struct progress *p);

/** The style that a word names ("bar", "lines", "json", "none", "auto"), or -1. */
int progress_style_of(const char *word);

/** One frame is done. `text` ("0.12 s, 2 views") appears on plain lines only. */
void progress_step(struct progress *p, uint64_t frame, const char *text);

/** Work on the first frame begins, `seconds` after the command started. Printed in JSON only. */
void progress_start(const struct progress *p, uint64_t frame, double seconds);

/**
 * So many of the frames before one have been played that are no work of the run. A bar shows it at once, lines tell it every ten seconds.
 * @param why  what the frame needs of them, borrowed until the next call; NULL: they are on the way
 */
void progress_replay(struct progress *p, uint64_t frame, uint64_t played, uint64_t of, const char *why);

/**
 * So many samples of a frame under way are done. A bar shows it at once, lines tell it every ten seconds.
 * @param of  how many it gets; 0: that shows in time
 */
void progress_sample(struct progress *p, uint64_t frame, uint32_t done, uint32_t of);

/** As progress_step, with a state ("done", "skipped", "failed") and the seconds that the frame took. */
void progress_frame(struct progress *p, uint64_t frame, const char *state, double seconds);

/** Print the totals of the run: frames, rate, slowest frames, peak memory. Call after progress_end. */
void progress_summary(const struct progress *p);

/** Clear the bar. Prints nothing itself. */
void progress_end(struct progress *p);

/** Seconds of a monotonic clock; only differences have a meaning. */
double progress_clock_s(void);
/** Seconds of processor time that this process has taken, all threads together. */
double progress_processor_s(void);
