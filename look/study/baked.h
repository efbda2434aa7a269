/*
 * Light in vertex colours: a program that knows no lightmaps may bake light into the colours of what stands still and
 * OpenGL does not light. Each vertex is a place in the world, its normal, and how much light falls there, as a
 * lightmap's texel is. Paint looks the same here: it is told apart as no lights explain it (findings.h).
 */
#pragma once

#include "look/study/lightmaps.h"

/** Study one more frame, after motion_add; vertices go where texels would. @return 0 or ERR_SYSTEM (reported) */
int baked_add(struct lightmaps *l, const struct scene *scene, const struct motion *motion);
