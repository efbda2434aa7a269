/* Computes the surface between solid and empty space from brushes. */
#pragma once

#include "level.h"
#include "mesh.h"

/** Add polygons to a mesh where solid meets empty, in the pieces that the brushes cut: many, not merged. */
void csg_build(const struct level *level, struct mesh *mesh);

/**
 * Add the parts of the level's portals in empty space, each as two faces, and cut the walls along their rims. The mesh
 * must be merged.
 */
void portals_cut(const struct level *level, struct mesh *mesh);
