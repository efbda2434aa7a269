/*
 * Progress of a run over frames: a bar with rate and time left where standard error is a terminal, one plain line per
 * frame elsewhere (farm managers parse "VERB frame N, DONE of TOTAL: TEXT").
 */
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

#include <stdint.h>

struct progress {
	const char *verb;   /* "rendered", "scored"; borrowed */
	uint64_t total;     /* frames in all; 0 where it is not known */
	uint64_t done;
	int terminal;
	double start_s;
};

/** Start a run of `total` frames. */
void progress_begin(struct progress *p, const char *verb, uint64_t total);

/** One frame is done. `text` says how it went ("0.12 s, 2 views"); shown on plain lines only. */
void progress_step(struct progress *p, uint64_t frame, const char *text);

/** Clear the bar. Prints nothing itself. */
void progress_end(struct progress *p);

/** Seconds on a clock that never runs backwards; only differences mean something. */
double progress_clock_s(void);

#endif
