/* Turns faces consistently. */
#pragma once

struct shape;

/**
 * Turn the faces of each part connected by edges of two triangles to one side. If every edge has an even number of
 * triangles, turn them outwards: a ray from outside has met an even number of faces. Counts turned and shells.
 * @param turns  0: only count shells
 * @return 0 or ERR_SYSTEM (reported)
 */
int turn_outwards(struct shape *s, int turns);
