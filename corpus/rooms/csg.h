/* Brushes into the surface between solid and empty. */
#pragma once

#include "level.h"
#include "mesh.h"

/** Add the polygons where solid meets empty to a mesh, as cut by the brushes: many, and not merged. */
void csg_build(const struct level *level, struct mesh *mesh);

/**
 * Add the level's portals as far as they lie in what is empty, each as two faces, and cut the walls along their rims.
 * The mesh is merged.
 */
void portals_cut(const struct level *level, struct mesh *mesh);
