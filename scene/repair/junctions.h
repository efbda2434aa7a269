/* Mends T-junctions: corners that lie on other triangles' edges. */
#pragma once

#include <stdint.h>

struct shape;

/**
 * Insert corners of open edges into the edges they lie on, alike for all triangles of an edge.
 * @param found  receives the number of corners inserted
 * @return 0 or ERR_SYSTEM (reported)
 */
int junctions_mend(struct shape *s, uint32_t *found);
