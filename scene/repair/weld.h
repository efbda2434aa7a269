/* Welds vertex positions to places. */
#pragma once

struct shape;

/**
 * Find the places of a mesh's vertices: fills points, point_of, size and tolerance. Positions closer than the tolerance
 * become one place, also if connected only through others.
 * @return 0 or ERR_SYSTEM (reported)
 */
int weld_points(struct shape *s);
