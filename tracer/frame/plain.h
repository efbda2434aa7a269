/*
 * Plain frames: cleared and drawn once, each pixel its nearest fragment, no mirrors. From camera rays to channels in
 * two kernels (kernels/frame/plain.h), with rays to lights between them.
 */
#pragma once

#include "tracer/frame/frame.h"

/** Whether this pass of the frame is plain. Needs job->prepared. */
int plain_suits(const struct job *job);

/** Draw the band into job->image. @return 0 or ERR_SYSTEM (reported) */
int plain_band(struct job *job);

/* --- For layered.c, which draws in the same way ------------------------------------------------------------------ */

/** What both ways ask of a frame: one pass, lights without a size. */
int plain_is_simple(const struct job *job);

/** Whether light leaves surfaces that mirror or let it through. */
int plain_has_mirrors(const struct job *job);

/** The arguments of both without light from all around. r: of the band */
struct plain_launch plain_launch_of(const struct job *job, struct camera_rectangle r, uint32_t n, uint32_t n_slots,
                                    const struct compose_request *request);

/** The planes that shadows change. */
struct compose_request plain_shadow_request(struct compose_request r);
