/* Frames in a row that came out alike: one line for all of them. */
#pragma once

#include "diff/report/output.h"

struct group {
	uint64_t first, last;
	const struct score *worst; /* the lowest fidelity, then most pixels off from the approved frame */
	unsigned failed;           /* bit g: gate g, in each of them */
};

/**
 * Gather frames that did not pass.
 * @param out   [most]
 * @param left  receives how many of these frames are in no group, as there are more than `most`
 * @return how many groups there are
 */
size_t groups_make(const struct output_run *run, struct group *out, size_t most, uint64_t *left);

/** Which comparison a gate belongs to: "not as approved", "not as the reference", "by itself". */
const char *groups_comparison(int gate);
