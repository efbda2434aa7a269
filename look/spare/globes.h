/*
 * Bodies around lamps. A lamp's own globe shows its outside, but the lamp sees its inside. sides.h covers the globes
 * whose parts show one side alone, by culling or lighting; this file covers those that can be recognized only as a
 * whole.
 */
#pragma once

#include "scene/scene.h"

struct blockers;

/**
 * Find the instances that make up a body around a light with a position. The body turns its back to the light
 * everywhere and surrounds it by its winding number: the solid angles of its triangles, seen from the light, add up
 * to more than half of all directions (A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983;
 * A. Jacobson et al., "Robust Inside-Outside Segmentation using Generalized Winding Numbers", 2013). The viewer is
 * outside. The visible side is determined by culling, else by normals, else by the winding of front faces. The body
 * may consist of any number of parts drawn one after another.
 *
 * @param blockers  of the scene; surfaces that block nothing are ignored
 * @param position  of the light, as in scene_light; lights at infinity have no globes
 * @param space     as in scene_view
 * @param bits      [n_instances]: receives SCENE_HIDDEN_FROM_LIGHTS for instances whose sides nothing else determines
 * @return the number of instances found
 */
uint32_t globes_find(const struct scene *scene, const struct blockers *blockers, const float position[4],
                     uint32_t space, uint32_t *bits);
