/* A triangle of a mesh, in a given space. */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct face {
	double corner[3][3], normal[3], area; /* normal: a unit vector; seen from its side, the corners run
	                                         counterclockwise */
};

/**
 * @param place  4 x 4, from the mesh to the space of the face
 * @return 1; 0: the triangle has no area, and so no normal
 */
int face_of(const struct scene_mesh *mesh, const double place[16], uint32_t primitive, struct face *out);

/**
 * The share of the window that a face in eye space covers, hidden or not.
 * @param size  receives half the window's width at its depth; undefined if the share is 0
 */
double face_share(const struct face *face, const float projection[16], double *size);
