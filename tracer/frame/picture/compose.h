/* Converts the pixels of a finished frame to the channels of an image. */
#pragma once

#include "tracer/frame/common/frame.h"
#include "tracer/image/image.h"

/**
 * Set the size, the requested channels and the attributes of an empty image.
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_start(const struct frame *frame, struct image *img);

/** Fill in the request for a band's planes, and make room for them. @return 0 or ERR_SYSTEM (reported) */
int compose_reserve(const struct band *band, struct compose_request *request);

/** Copy the band's planes to pass->image. @return 0 or ERR_SYSTEM (reported) */
int compose_fetch(const struct band *band, const struct compose_request *request);

/**
 * Fill in a band's rows of pass->image. Bands are passed from the top down.
 * @param band  buffers.frame has the band's pixels; if there were several passes, buffers.sums has the sums of all but
 *             this one
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_band(const struct band *band);

/** 1 if a picture has the channels of a group. */
int compose_asks(const struct tracer_options *options, const char *group);

/** The names of all channel groups, followed by NULL. */
extern const char *const compose_groups[];
