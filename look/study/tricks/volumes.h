/*
 * Shadow volumes in the stencil buffer (Crow 1977; Heidmann 1991 z-pass, Bilodeau and Songy 1999 z-fail): draws
 * without colour that count faces. Edges that lead from an outline away from the light all meet in the light.
 */
#pragma once

#include "look/study/tricks/tricks.h"

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int volumes_add(struct tricks *t, const struct scene *scene, const struct motion *motion);
