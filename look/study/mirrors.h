/*
 * Mirrors drawn as the world behind them: meshes drawn once as they are and once under a reflection, p' = p - 2 (n . p
 * + d) n. What leads from the one draw to the other holds the plane. The mirror itself lies in it, blended over the
 * picture.
 */
#pragma once

#include "look/study/tricks.h"

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int mirrors_add(struct tricks *t, const struct scene *scene, const struct motion *motion);
