/* From the pixels of a finished frame to the channels of an image. */
#ifndef TRACER_COMPOSE_H
#define TRACER_COMPOSE_H

#include "kernels/shared.h"
#include "tracer/image.h"
#include "tracer/trace.h"

/**
 * @param pixels  [height][width], row 0 at the bottom
 * @param planes  [height][width][SURFACE_PLANES], likewise
 * @param img     width and height set; receives the channels
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_image(const struct frame_pixel *pixels, const float *planes, const struct tracer_options *options,
                  struct image *img);

/** 1 where the option's list of channel groups holds this one. */
int compose_wants(const char *aov, const char *group);

/** The names of all channel groups, NULL at the end. */
extern const char *const compose_groups[];

#endif
