/*
 * Mirrors drawn as a second world behind them. Meshes are drawn once as they are and once reflected, p' = p - 2 (n .
 * p + d) n; the matrix from one draw to the other gives the plane. The mirror itself lies in that plane and is
 * blended over the reflected meshes.
 */
#pragma once

#include "look/study/tricks/tricks.h"

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int mirrors_add(struct tricks *t, const struct scene *scene, const struct motion *motion);
