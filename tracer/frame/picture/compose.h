/* Converts the pixels of a finished frame to the channels of an image. */
#pragma once

#include "tracer/frame/common/frame.h"
#include "tracer/image/image.h"

/**
 * Set the size, the requested channels and the attributes of an empty image.
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_start(const struct frame *frame, struct image *img);

/* The planes of a band: which there are, and their buffers. */
struct compose_planes {
	struct compose_request request;
	union buffer_half halves;
	union buffer_float floats;
};

/** Choose a band's planes, and make room for them. @return 0, ERR_MEMORY or ERR_SYSTEM (reported) */
int compose_reserve(const struct band *band, struct compose_planes *out);

/** Copy the band's planes to pass->image. @return 0 or ERR_SYSTEM (reported) */
int compose_fetch(const struct band *band, const struct compose_planes *from);

/**
 * Fill in a band's rows of pass->image from its pixels; if there were several passes, from the sums of all but this
 * one, too. Bands are passed from the top down.
 * @param cleared  a pixel that is not drawn to
 * @param drawn    1 for each pixel that is in the frame; used by packets
 * @return 0 or ERR_SYSTEM (reported)
 */
int compose_band(const struct band *band, union buffer_frame_pixel cleared, union buffer_uint drawn);

/** Make room for the sums of passes; add the pixels of this pass to them. */
int compose_reserve_sums(const struct frame *frame);
int compose_add_pass(const struct band *band);

/** 1 if a picture has the channels of a group. */
int compose_asks(const struct tracer_options *options, const char *group);

/** The names of all channel groups, followed by NULL. */
extern const char *const compose_groups[];
