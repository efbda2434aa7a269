/* Groups consecutive frames with the same result, to be printed as one line. */
#pragma once

#include "diff/report/output.h"

struct group {
	uint64_t first, last;
	const struct score *worst; /* the lowest fidelity, then most pixels off from the approved frame */
	unsigned failed;           /* bit g: gate g failed in each of them */
};

/**
 * Group the frames that did not pass.
 * @param out   [most]
 * @param left  receives the number of frames left over, as there are more than `most` groups
 * @return number of groups
 */
size_t groups_make(const struct output_run *run, struct group *out, size_t most, uint64_t *left);

/** The comparison that a gate belongs to, in words for people. */
const char *groups_comparison(int gate);
