/*
 * Compares several runs of the same frames with one reference, and tells noise from regressions.
 *
 * A frame is flaky if it fails in some run but its composite passes (composite.h). It is a regression if the composite
 * fails as well, or if a gate that looks at more than colours and depth fails in every run.
 */
#pragma once

#include "diff/runs/composite.h"
#include "diff/runs/scoring.h"

enum { RUNS_MOST = 32 };

enum runs_verdict { RUNS_STEADY, RUNS_FLAKY, RUNS_REGRESSION };

struct runs_frame {
	uint64_t frame;
	enum runs_verdict verdict;
	unsigned failing, missing;   /* runs that fail; those of them without such a picture */
	unsigned n_failed[N_GATES];  /* runs that fail each gate */
	unsigned steady_gates;       /* bit g: gate g fails regardless of noise */
	unsigned unknown_gates;      /* bit g: gate g fails in some run, and the rules do not list it as flaky there */
	struct composite_varying varying;
};

struct runs {
	struct output_run *runs; /* [n], scored */
	size_t n;
	struct set *ref, *sets;  /* sets: [n] */
	const uint64_t *frames;  /* [n_frames] */
	size_t n_frames;
	const char *match;       /* the recording's name, for proposed entries; NULL: not known */
};

/** Judge every frame. @param out  [n_frames] @return 0 or ERR_* (reported) */
int runs_judge(const struct runs *r, struct runs_frame *out);

/** Print the table: a line for each frame that fails in some run, then a summary. */
void runs_table(const struct runs *r, const struct runs_frame *frames, FILE *out);

/**
 * Print entries for `flaky:` of relume-diff.yaml; frames with the same gates share one.
 * @param days  lifetime of the entries
 * @return number of entries
 */
size_t runs_quarantine(const struct runs *r, const struct runs_frame *frames, unsigned days, FILE *out);

/** Print a line for each bar and flaky entry of the rules that no frame of any run needed. @return 0 or ERR_SYSTEM
 * (reported) */
int runs_unneeded(const struct runs *r, FILE *out);
