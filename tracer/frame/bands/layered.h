/*
 * Frames on CPUs that are like plain ones (plain.h) except for their draws: several segments, blending, alpha tests, no
 * depth tests. Camera rays of all segments are traced first. Then two kernels draw all fragments of a pixel over each
 * other (kernels/frame/layered/layered.cl). If a pixel has more than PLAIN_LAYERS fragments, both steps are repeated in
 * rounds. Pictures of GL's frame buffer are made in the same way.
 */
#pragma once

#include "tracer/frame/common/frame.h"

/** 1 if this pass of the frame can be drawn in this way. The frame must be placed. */
int layered_suits(const struct pass *pass);

/** Pixels in a band whose data stays in the caches: a column may have eight fragments. */
uint32_t layered_pixels(const struct frame *frame);

/** Draw the band into pass->image or pass->picture. @return 0 or ERR_SYSTEM (reported) */
int layered_band(struct band *band);
