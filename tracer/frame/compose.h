/* From the pixels of a finished frame to the channels of an image. */
#pragma once

#include "tracer/frame/frame.h"
#include "tracer/image/image.h"

/**
 * @param job  its frame stands in buffers.frame, the sums of all passes but this one, where there were several, in buffers.sums
 * @param img  width and height set; receives the channels
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_image(struct job *job, struct image *img);

/** 1 where the option's list of channel groups holds this one. */
int compose_wants(const char *aov, const char *group);

/** The names of all channel groups, NULL at the end. */
extern const char *const compose_groups[];
