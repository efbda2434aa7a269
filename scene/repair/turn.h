/* Which way faces look. */
#pragma once

struct shape;

/**
 * Turn faces of each part that hangs together by edges of two triangles to one side; where every edge has an even
 * number of triangles, outwards: a ray from outside has met an even number of faces. Counts turned and shells.
 * @param turns  0: count shells only
 * @return 0 or ERR_SYSTEM (reported)
 */
int turn_outwards(struct shape *s, int turns);
