/* Light from all around on what GL does not light, as rules want it (kernels/frame/dome.h). */
#pragma once

#include "tracer/device/launch.h"
#include "tracer/frame/frame.h"

/** Whether there is such light in the frame. */
int dome_is_there(const struct job *job);

/**
 * Light the fragments of the list.
 * @param space      what rays from them may hit
 * @param rectangle  where they lie, counted from the band's first row
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int dome_light_list(struct job *job, const struct accel_space *space, struct camera_rectangle rectangle, uint32_t n);

/** Whether a plain frame with such light, if there is any, stays plain: its rays are traced at once. */
int dome_suits_plain(const struct job *job);

/** Make room for such light on a plain frame's n places, and say where it is looked for. samples: receives the rays of
 * each */
int dome_prepare_plain(struct job *job, uint32_t n, uint32_t *samples);

/** What plain_dome's looks around saw, as factors for plain_shadow. @return 0, ERR_MEMORY or ERR_SYSTEM (reported) */
int dome_light_plain(struct job *job, const struct accel_space *space, const struct plain_launch *a);
