/*
 * Bodies around lamps. A lamp's own globe shows its outside, and the lamp sees its inside. Where culling or lighting
 * tell that a part of it shows one side alone, look/sides.h sees to it; here it is told by the whole body.
 */
#pragma once

#include "scene/scene.h"

struct blockers;

/**
 * Find the instances that make up a body around a light with a place. A body shows its back to the light everywhere,
 * and surrounds it by the winding number: the solid angles of its triangles, seen from the light, come to more than
 * half of all directions (A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983; A. Jacobson
 * et al., "Robust Inside-Outside Segmentation using Generalized Winding Numbers", 2013). The viewer is outside of it.
 * Which side is shown says culling, or else normals, or else the winding of front faces. It may be drawn in any
 * number of parts, one after the other.
 *
 * @param blockers  of the scene; what blocks nothing is not looked at
 * @param position  of the light, as in scene_light; lights at infinity have no globes
 * @param space     as in scene_view
 * @param bits      [n_instances]: receives SCENE_HIDDEN_FROM_LIGHTS for instances of which nothing else tells the sides
 * @return how many instances
 */
uint32_t globes_find(const struct scene *scene, const struct blockers *blockers, const float position[4],
                     uint32_t space, uint32_t *bits);
