/* Removes vertices that do not change the surface. */
#pragma once

#include <stdint.h>

struct shape;

/**
 * Remove places whose triangles lie in one plane, or in two that meet in a straight edge, if all attributes continue
 * linearly across them: one of the place's edges collapses (H. Hoppe et al., "Mesh Optimization", 1993, edge collapse).
 * Under flat shading, all triangles of a plane must have one colour. Vertices made for junctions must be in the mesh
 * already.
 * @param merged  receives the number of places removed
 * @return 0 or ERR_SYSTEM (reported)
 */
int merge_flat(struct shape *s, uint32_t *merged);
