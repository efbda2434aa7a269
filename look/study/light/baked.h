/*
 * Light in vertex colours. A program without lightmaps may bake light into the colours of static meshes that OpenGL
 * does not light. Each vertex gives a place in the world, its normal, and the light that falls there, like a texel of
 * a lightmap. Painted colours look the same at this stage; relight.h rejects them, because no lights explain them.
 */
#pragma once

#include "look/study/light/lightmaps.h"

/** Study one more frame, after motion_add; vertices are added as texels. @return 0 or ERR_SYSTEM (reported) */
int baked_add(struct lightmaps *l, const struct scene *scene, const struct motion *motion);
