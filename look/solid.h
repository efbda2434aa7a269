/* What a frame's world is made of. */
#pragma once

#include "scene/scene.h"

/** 1 for filled things in the window that have depth, and not all the same one, as skies may have; nor a depth that is
 * cleared (scene/backdrop.h). */
int solid_is(const struct scene *scene, const struct scene_instance *instance);
