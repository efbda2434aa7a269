/*
 * Surfaces that shine, as mode path asks them for light (kernels/frame/emitter.h).
 */
#pragma once

#include "tracer/frame/frame.h"

/**
 * List the triangles of a frame that shine, space by space, on the device.
 * @param job        its geometry is placed; job->emissions receives a list for each space, empty where nothing is to be
 * asked for
 * @param transport  TRANSPORT_*: all but those of mode path have no lists
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int emitters_place(struct job *job, uint32_t transport);

/** Those of a space, for a launch. */
struct emission_launch emitters_of(const struct job *job, const struct accel_space *space);
