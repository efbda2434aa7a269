/* Light from all directions on surfaces that GL does not light, as set by rules (kernels/frame/dome/dome.h). */
#pragma once

#include "tracer/device/launch.h"
#include "tracer/frame/common/frame.h"

/** 1 if there is such light in the frame. */
int dome_is_there(const struct frame *frame);

/**
 * Light the fragments of the list.
 * @param space      what rays from the fragments may hit
 * @param rectangle  area of the fragments, counted from the band's first row
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int dome_light_list(const struct band *band, const struct accel_space *space, struct camera_rectangle rectangle,
                    uint32_t n);

/** 1 if a plain frame stays plain with the dome light it has, if any: all its rays can be traced at once. */
int dome_suits_plain(const struct frame *frame);

/** Make room for such light at a plain frame's n places, and upload the directions of its rays. samples: receives the
 * rays per place */
int dome_prepare_plain(const struct frame *frame, uint32_t n, uint32_t *samples);

/** Trace the rays of plain_dome, and make factors for plain_shadow from their results. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int dome_light_plain(const struct band *band, const struct accel_space *space, const struct plain_launch *a);
