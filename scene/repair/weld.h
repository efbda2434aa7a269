/* Vertices' positions -> places. */
#pragma once

struct shape;

/**
 * Find the places of a mesh's vertices: fills points, point_of, size and tolerance. Positions nearer than the tolerance
 * are one place, and so are those that are joined by such steps.
 * @return 0 or ERR_SYSTEM (reported)
 */
int weld_points(struct shape *s);
