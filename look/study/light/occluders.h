/* Static geometry that blocks light: triangles in world space, and whether one lies between two points. */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct occluder_node;

/* All zero: empty. */
struct occluders {
	double (*corners)[9]; /* three for each triangle */
	size_t n, room;
	struct occluder_node *nodes; /* set by occluders_build */
};

/** @return 0 or ERR_SYSTEM (reported) */
int occluders_put(struct occluders *o, const double corners[9]);
/** Call after the last triangle and before the first query. @return 0 or ERR_SYSTEM (reported) */
int occluders_build(struct occluders *o);
void occluders_free(struct occluders *o);

/**
 * 1 if nothing lies between two points, apart from a thousandth of the way at either end.
 * @param blocker  the triangle to try first; receives the one that blocks the way. Any number will do at first
 */
int occluders_sees(const struct occluders *o, const double from[3], const double to[3], uint32_t *blocker);
