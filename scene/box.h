/* Bounding boxes of meshes, in object space. */
#pragma once

#include "scene/scene.h"

/** Extend a box to contain a mesh's points. An empty box has low INFINITY and high -INFINITY. */
void scene_box_grow(const struct scene_mesh *mesh, float low[3], float high[3]);

/** The bounding box of a mesh; all 0 if it has no points. */
void scene_box(const struct scene_mesh *mesh, float low[3], float high[3]);
