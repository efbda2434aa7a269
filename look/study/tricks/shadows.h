/*
 * Shadows flattened onto a plane (Blinn 1988, "Me and My (Fake) Shadow"). A mesh is drawn once as it is, and once
 * more under a matrix that projects it away from the light: in a dark colour, or into the stencil buffer for a later
 * draw that darkens. The matrix from one draw to the other is k I - L P^T in eye space; its null vector is the light
 * L, its left null vector the plane P.
 */
#pragma once

#include "look/study/tricks/tricks.h"

struct pairs;

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int shadows_add(struct tricks *t, const struct scene *scene, const struct motion *motion);
