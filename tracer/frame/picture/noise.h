/* Measures the noise in the mean of a frame's samples, from their sums (kernels/frame/stages/compose.h, add_pass). */
#pragma once

#include "tracer/frame/common/frame.h"

/* State of the last measurement. All zero: not measured yet. */
struct noise {
	float *sums;    /* brightness, [pixels] */
	uint32_t passes;
};

void noise_free(struct noise *noise);

/**
 * Measure the noise by comparing the samples since the last measurement with those before. The result is the standard
 * error of a pixel's brightness, as the root mean square over all pixels, divided by the mean brightness of the
 * picture. Samples are spread more evenly than random ones, so this is an overestimate.
 * @param passes  number of passes summed so far; more than the last time
 * @param out     receives the noise; FLT_MAX at the first measurement
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int noise_measure(const struct frame *frame, struct noise *noise, uint32_t passes, float *out);
