/* A triangle of a mesh where it stands. */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct face {
	double corner[3][3], normal[3], area; /* normal: of unit length, on the side from which its corners go round
	                                         counterclockwise */
};

/** @param place  4 x 4, from the mesh to where it is looked at. @return 1; 0: the triangle has no area, and no
 * normal */
int face_of(const struct scene_mesh *mesh, const double place[16], uint32_t primitive, struct face *out);

/**
 * The share of the window that a face in eye space covers, in front of everything or not.
 * @param size  receives half the window's width where it stands; undefined where the share is 0
 */
double face_share(const struct face *face, const float projection[16], double *size);
