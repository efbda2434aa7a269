/*
 * Emissive surfaces, which mode path samples for light (kernels/frame/light/emitter.h).
 */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Upload a list of the frame's emissive triangles, space by space.
 * @param frame      its geometry must have been placed; frame->emissions receives a list for each space, empty if
 *                   nothing is to be sampled
 * @param transport  TRANSPORT_*: only those of mode path have lists
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int emitters_place(struct frame *frame, uint32_t transport);

/** The emissive triangles of a space, for a launch. */
struct emission_launch emitters_of(const struct frame *frame, const struct accel_space *space);
