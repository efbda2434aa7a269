/*
 * Several runs of the same frames, held against one reference: which failures are noise, and which are not.
 *
 * A frame is flaky where it fails in some run, and what all runs have in common passes (composite.h). It is a
 * regression where that fails as well, or where a gate that looks at more than colours and depth fails in every run.
 */
#pragma once

#include "diff/runs/composite.h"
#include "diff/runs/scoring.h"

enum { RUNS_MOST = 32 };

enum runs_verdict { RUNS_STEADY, RUNS_FLAKY, RUNS_REGRESSION };

struct runs_frame {
	uint64_t frame;
	enum runs_verdict verdict;
	unsigned failing, missing;   /* runs that fail; of these: that have no such picture */
	unsigned n_failed[N_GATES];  /* runs in which a gate fails */
	unsigned steady_gates;       /* bit g: gate g fails whatever the noise */
	unsigned unknown_gates;      /* bit g: gate g fails in some run in which the rules do not list it as flaky */
	struct composite_varying varying;
};

struct runs {
	struct output_run *runs; /* [n], scored */
	size_t n;
	struct set *ref, *sets;  /* sets: [n] */
	const uint64_t *frames;  /* [n_frames] */
	size_t n_frames;
	const char *match;       /* the recording's name, for entries that are proposed; NULL: none is known */
};

/** Judge every frame. @param out  [n_frames] @return 0 or ERR_* (reported) */
int runs_judge(const struct runs *r, struct runs_frame *out);

/** The table: a line for each frame that fails in some run; then a summary. */
void runs_table(const struct runs *r, const struct runs_frame *frames, FILE *out);

/**
 * Entries for `flaky:` of relume-diff.yaml, frames of the same gates together.
 * @param days  after which they expire
 * @return how many
 */
size_t runs_quarantine(const struct runs *r, const struct runs_frame *frames, unsigned days, FILE *out);

/** A line for each bar and flaky entry of the rules that no frame of any run needed. @return 0 or ERR_SYSTEM
 * (reported) */
int runs_unneeded(const struct runs *r, FILE *out);
