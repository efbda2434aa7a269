/*
 * Plain frames on CPUs: cleared and drawn once, each pixel its nearest fragment, no mirrors. From camera rays to channels in two kernels
 * (kernels/frame/plain.h), with rays to lights between them.
 */
#pragma once

#include "tracer/frame/frame.h"

/** Whether this pass of the frame is plain. Needs job->prepared. */
int plain_suits(const struct job *job);

/** Draw the band into job->image. @return 0 or ERR_SYSTEM (reported) */
int plain_band(struct job *job);
