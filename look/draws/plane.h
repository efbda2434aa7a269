/* Draws that lie in a plane. */
#pragma once

#include "scene/scene.h"

/** 1 if nine tenths of a draw's points lie in a plane of eye space (a, b, c, d; the normal is a unit vector). The rest
 * may be an edge. */
int plane_holds(const struct scene *scene, const struct scene_instance *instance, const float plane[4]);
