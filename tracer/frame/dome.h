/* Light from all around on what GL does not light, as rules want it (kernels/frame/dome.h). */
#pragma once

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
