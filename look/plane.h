/* Draws in a plane. */
#pragma once

#include "scene/scene.h"

/** 1 where a draw lies in a plane of eye space (a, b, c, d; the normal a unit vector), but for a tenth of its points:
 * an edge, perhaps. */
int plane_holds(const struct scene *scene, const struct scene_instance *instance, const float plane[4]);
