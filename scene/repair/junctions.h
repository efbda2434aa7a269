/* Corners on other triangles' edges. */
#pragma once

#include <stdint.h>

struct shape;

/**
 * Give edges the corners of open edges that lie on them, all triangles of an edge alike.
 * @param found  receives how many corners edges got
 * @return 0 or ERR_SYSTEM (reported)
 */
int junctions_mend(struct shape *s, uint32_t *found);
