/* Vertices that change nothing. */
#pragma once

#include <stdint.h>

struct shape;

/**
 * Take places away whose triangles lie in one plane, or in two that meet in a straight edge, and go on evenly in all
 * attributes across them: one of the place's edges shrinks to nothing (H. Hoppe et al., "Mesh Optimization", 1993, edge
 * collapse). Under flat shading each plane's triangles have one colour. Vertices made for junctions must be in the mesh
 * already.
 * @param merged  receives how many places went
 * @return 0 or ERR_SYSTEM (reported)
 */
int merge_flat(struct shape *s, uint32_t *merged);
