/* Rays of a user's hook in place of a camera's: kernels/frame/hook.h. Functions return as those of hooks.h. */
#pragma once

#include "tracer/frame/frame.h"

/** 1 where a hook's rays stand in for a segment's camera: its eye space is the one that most instances are in. */
int hook_rays_stand_in(const struct job *job, const struct segment *segment);

/** A band of such a segment: its clears but the first n_cleared, and the rays. Of several segments of the space the
 * first one shows all. */
int hook_rays_run(struct job *job, const struct segment *segment, uint32_t n_cleared);
