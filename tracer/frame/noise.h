/* How noisy the mean of a frame's samples is, as its sums say (kernels/frame/compose.h, add_pass). */
#pragma once

#include "tracer/frame/frame.h"

/* What was known when it was measured last; all zero: nothing. */
struct noise {
	float *sums;    /* brightness, [pixels] */
	uint32_t passes;
};

void noise_free(struct noise *noise);

/**
 * Measure. The samples since the last time against those before: the standard error of a pixel's brightness, the root
 * mean square of all pixels, over the mean brightness of the picture. Samples lie more evenly than chance would have
 * them, so this is rather too much.
 * @param passes  that were added up; more than the last time
 * @param out     receives it; FLT_MAX: the first time
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int noise_measure(struct job *job, struct noise *noise, uint32_t passes, float *out);
