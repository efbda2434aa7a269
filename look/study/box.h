/* The box around points. */
#pragma once

#include "scene/scene.h"

struct box {
	double low[3], high[3];
};

/* Around nothing. */
extern const struct box box_empty;

void box_widen(struct box *b, const double at[3]);

/**
 * Around a mesh's points.
 * @param place  4 x 4, from the mesh to where it is looked at
 */
struct box box_of(const struct scene_mesh *mesh, const double place[16]);

/** Its middle and the length of its diagonal; both 0 where it is around nothing. */
double box_measure(const struct box *b, double middle[3]);
