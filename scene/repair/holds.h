/* Inside or outside. */
#pragma once

#include "scene/scene.h"

/**
 * 1 where a closed mesh (repair_found.closed) holds a place in its material: hollows do not count. By the winding
 * number, from the solid angles of all triangles (A. van Oosterom and J. Strackee, "The Solid Angle of a Plane
 * Triangle", 1983), so that no ray can miss an edge.
 */
int holds_place(const struct scene_mesh *mesh, const float at[3]);
