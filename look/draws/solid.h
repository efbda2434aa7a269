/* Solid surfaces of a frame. */
#pragma once

#include "scene/scene.h"

/** 1 for filled draws in the window that vary in depth, unlike some skies, and whose depth is not cleared later
 * (scene/backdrop.h). */
int solid_is(const struct scene *scene, const struct scene_instance *instance);
