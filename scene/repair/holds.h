/* Tests whether a place is inside or outside a mesh. */
#pragma once

#include "scene/scene.h"

/**
 * 1 if a closed mesh (repair_found.closed) holds a place in its material; hollows are outside. Uses the winding number,
 * a sum of the solid angles of all triangles (A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle",
 * 1983), so no ray can slip through an edge.
 */
int holds_place(const struct scene_mesh *mesh, const float at[3]);
