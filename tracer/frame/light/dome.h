/* Light from all directions on surfaces that GL does not light, as set by rules (kernels/frame/dome/dome.h). */
#pragma once

#include "tracer/device/launch.h"
#include "tracer/frame/common/frame.h"

/* X(element, name): buffers of this file. */
#define DOME_BUFFERS(X) X(dome_place, places) X(float, sums) X(float, directions) X(ray, rays) X(float, factors)
struct dome_buffers {
	DOME_BUFFERS(FRAME_FIELD)
};

/** 1 if there is such light in the frame. */
int dome_is_there(const struct frame *frame);

/* The area of a list's fragments. */
struct dome_area {
	struct camera_rectangle rectangle; /* counted from the band's first row */
	union buffer_uint counts, first;   /* for each pixel: number of fragments, index of the first in the list */
};

/**
 * Light the fragments of a list.
 * @param space  what rays from the fragments may hit
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int dome_light_list(const struct band *band, const struct accel_space *space, const struct fragment_list *from,
                    const struct dome_area *area);

/** 1 if a plain frame stays plain with the dome light it has, if any: all its rays can be traced at once. */
int dome_suits_plain(const struct frame *frame);

/* Arguments of plain_dome, by the same names. */
struct dome_plain {
	union buffer_float directions, factors;
	union buffer_ray looks;
	union buffer_dome_place places;
	uint32_t samples; /* rays of each place */
};

/** Make room for such light at a plain frame's n places, and upload the directions of its rays. */
int dome_prepare_plain(const struct frame *frame, uint32_t n, struct dome_plain *out);

/** The same for a frame without such light: buffers of one element, samples 0. */
int dome_prepare_none(const struct frame *frame, struct dome_plain *out);

/** Trace the rays of plain_dome, and make factors for plain_shadow from their results. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int dome_light_plain(const struct band *band, const struct accel_space *space, const struct plain_launch *a);
