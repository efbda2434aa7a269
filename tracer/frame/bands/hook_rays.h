/* Rays of a user's hook that replace the camera's: kernels/frame/hook/hook.h. Functions return the same values as those
 * of hooks.h. */
#pragma once

#include "tracer/frame/common/frame.h"

/** 1 if a hook's rays replace a segment's camera: its eye space is the one with most instances. */
int hook_rays_stand_in(const struct frame *frame, const struct segment *segment);

/** Draw a band of such a segment: its clears except the first n_cleared, then the rays. If the space has several
 * segments, the first one shows them all. */
int hook_rays_run(struct band *band, const struct segment *segment, uint32_t n_cleared);
