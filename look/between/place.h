/* The place of a draw: the box around its mesh, in eye space. */
#pragma once

#include "scene/scene.h"

struct place {
	double corner[8][4]; /* bit c of the index is 1 for the upper end along axis c of object space */
	double size;         /* the longest diagonal; more than 0 */
};

/**
 * Find the place of a draw.
 * @param box     of the mesh, [low, high]
 * @param motion  takes the draw to another eye space, or NULL
 */
void place_find(const struct scene_instance *in, const float box[2][3], const double *motion, struct place *out);

/** The largest distance between corresponding corners of two boxes. */
double place_way(const struct place *a, const struct place *b);
