/* Which draws of a frame ran which of the application's programs, as a picture says it. */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/**
 * Set the attribute relume:programs: "program object 7=1-4,9-9;vertex program 3=5-6", draw numbers of each; not where
 * there are none.
 * @return 0 or ERR_SYSTEM (reported)
 */
int programs_tell(const struct scene *scene, struct image *img);
