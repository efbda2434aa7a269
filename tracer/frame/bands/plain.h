/*
 * Plain frames are cleared and drawn once, show the nearest fragment of each pixel, and have no mirrors. They take two
 * kernels from camera rays to channels (kernels/frame/plain/plain.h), with rays to lights between them.
 */
#pragma once

#include "tracer/frame/common/frame.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/picture/compose.h"

/** 1 if this pass of the frame is plain. The frame must be placed. */
int plain_suits(const struct pass *pass);

/** Draw the band into pass->image. @return 0 or ERR_SYSTEM (reported) */
int plain_band(struct band *band);

/* --- For layered.c, which draws in the same way ------------------------------------------------------------------ */

/** 1 if a frame meets the conditions of both ways: one pass, lights without a size. */
int plain_is_simple(const struct pass *pass);

/** 1 if there are surfaces that reflect or transmit light. */
int plain_has_mirrors(const struct frame *frame);

/** Make room for one element in each buffer that only layered.c uses. */
int plain_reserve_unused(const struct frame *frame);

/** Arguments of both ways: for a list with room for the fragments, rays to n_slots lights each, and the dome's rays.
 * The area of the view is empty. */
struct plain_launch plain_launch_of(const struct band *band, const struct fragment_list *list,
                                    const struct light_rays *rays, uint32_t n_slots, const struct dome_plain *dome,
                                    const struct compose_planes *to);

/** Trace the rays to lights that the kernels of such a launch made. */
int plain_trace_rays(const struct frame *frame, const struct accel_space *space, const struct plain_launch *a);

/** Restrict a request to the planes that shadows change. */
struct compose_request plain_shadow_request(struct compose_request r);
