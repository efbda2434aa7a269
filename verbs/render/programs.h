/* Notes in a picture which shader programs of the application drew what. */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/**
 * Set the attribute relume:programs: "program object 7=1-4,9-9;vertex program 3=5-6", the draw numbers of each.
 * Not set if no draw ran a program.
 * @return 0 or ERR_SYSTEM (reported)
 */
int programs_tell(const struct scene *scene, struct image *img);
