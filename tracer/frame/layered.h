/*
 * Frames on CPUs that are like plain ones (plain.h) but for their draws: of several segments, blended, tested for
 * alpha, not tested for depth. The camera looks at all segments first; then two kernels draw all fragments of a pixel
 * one over the other (kernels/frame/layered.cl). Where these are more than PLAIN_LAYERS, both do so in rounds. Pictures
 * as GL's frame buffer has them are made in the same way.
 */
#pragma once

#include "tracer/frame/frame.h"

/** Whether this pass of the frame is so. Needs job->prepared. */
int layered_suits(const struct job *job);

/** Whether it is so, and a pixel may have many fragments. */
int layered_has_columns(const struct job *job);

/** So many pixels a band may have. */
uint32_t layered_most_pixels(void);

/** Draw the band into job->image or job->picture. @return 0 or ERR_SYSTEM (reported) */
int layered_band(struct job *job);
