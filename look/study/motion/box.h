/* The box around points. */
#pragma once

#include "scene/scene.h"

struct box {
	double low[3], high[3];
};

/* Encloses nothing. */
extern const struct box box_empty;

void box_widen(struct box *b, const double at[3]);

/**
 * The box around a mesh's points.
 * @param place  4 x 4, from the mesh to the space of the box
 */
struct box box_of(const struct scene_mesh *mesh, const double place[16]);

/** The middle of a box and the length of its diagonal; both are 0 for an empty box. */
double box_measure(const struct box *b, double middle[3]);
