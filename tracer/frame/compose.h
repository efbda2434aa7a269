/* From the pixels of a finished frame to the channels of an image. */
#pragma once

#include "tracer/frame/frame.h"
#include "tracer/image/image.h"

/**
 * Give an empty image its size, the channels that are asked for, and attributes.
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_start(const struct job *job, struct image *img);

/** What the kernels are asked to make of a band, and room for its planes. @return 0 or ERR_SYSTEM (reported) */
int compose_reserve(struct job *job, struct compose_request *request);

/** Hand the band's planes to what compose_start made. @return 0 or ERR_SYSTEM (reported) */
int compose_fetch(struct job *job, const struct compose_request *request, struct image *img);

/**
 * Fill in a band's rows. Bands come from the top.
 * @param job  its pixels stand in buffers.frame, the sums of all passes but this one, where there were several, in
 * buffers.sums
 * @param img  what compose_start made
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_band(struct job *job, struct image *img);

/** 1 where a picture has the channels of a group. */
int compose_asks(const struct tracer_options *options, const char *group);

/** The names of all channel groups, NULL at the end. */
extern const char *const compose_groups[];
