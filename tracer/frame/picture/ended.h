/* Programs stopped by the limit SCENE_PROGRAM_STEPS. Their output is incomplete, and the frame records that. */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Count a frame's draws whose programs were stopped. Call after the last pass.
 * @param img  receives the attribute relume:ended with the numbers of the draws; NULL: there is no picture with
 *             attributes
 * @param ended  their number is added to it
 */
int ended_count(const struct frame *frame, struct image *img, uint64_t *ended);
