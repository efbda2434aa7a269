/* Lists the frames of sets, and scores them in threads. */
#pragma once

#include "base/frames.h"
#include "diff/baseline/baseline.h"
#include "diff/pictures/set.h"
#include "diff/report/output.h"

/* Inputs of scoring. */
struct scoring {
	struct set *ref, *traced;
	const struct baseline *baseline;
	const struct output_run *run;
};

/* The frames requested. */
struct scoring_asked {
	const struct frame_list *frames; /* -f; empty: none listed */
	int all; /* 1: all frames of any set or the baseline; if frames are listed, those of them */
};

/**
 * List the frames to score: without `all`, the listed ones, or those of the last set if none are listed.
 * @param out, n_out  receive them in order; free with free()
 * @return 0, ERR_USAGE (reported: none) or ERR_SYSTEM (reported)
 */
int scoring_list(const struct set *const *sets, size_t n_sets, const struct baseline *baseline,
                 const struct scoring_asked *asked, uint64_t **out, size_t *n_out);

/**
 * Score an image in memory against a reference, an approved frame, or both.
 * @param picture  the reference; if there is none, of the image's size and without pixels
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int scoring_image(const struct scoring *all, uint64_t frame, struct score_picture *picture, const struct image *image,
                  struct score *out);

/**
 * Score frames.
 * @param frames  [run->n_scores]
 * @param run     scores, counts and seconds are filled in
 * @return 0, ERR_USAGE (reported: no frame has the layer of --channel) or ERR_SYSTEM (reported)
 */
int scoring_all(struct set *ref, struct set *traced, const struct baseline *baseline, const uint64_t *frames,
                struct output_run *run);
