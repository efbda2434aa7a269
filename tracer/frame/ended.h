/* Programs that SCENE_PROGRAM_STEPS ended: what they drew is not what they mean, and the frame says so. */
#pragma once

#include "tracer/frame/frame.h"

/**
 * Count a frame's draws whose programs were ended, in tracer.undrawn. After its last pass.
 * @param img  gets the attribute relume:ended with their numbers; NULL: there is no picture with attributes
 */
int ended_count(struct job *job, struct image *img);
