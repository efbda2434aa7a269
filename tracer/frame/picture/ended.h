/* Programs stopped by the limit SCENE_PROGRAM_STEPS. Their output is incomplete, and the frame records that. */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Count a frame's draws whose programs were stopped, in tracer.undrawn. Call after the last pass.
 * @param img  receives the attribute relume:ended with the numbers of the draws; NULL: there is no picture with
 *             attributes
 */
int ended_count(struct job *job, struct image *img);
