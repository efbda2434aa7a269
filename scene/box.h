/* Boxes about meshes, in object space. */
#pragma once

#include "scene/scene.h"

/** Let a box hold a mesh's points, too. An empty one has INFINITY for low and -INFINITY for high. */
void scene_box_grow(const struct scene_mesh *mesh, float low[3], float high[3]);

/** The box of a mesh; all 0 if it has no points. */
void scene_box(const struct scene_mesh *mesh, float low[3], float high[3]);
