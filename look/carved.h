/*
 * Draws of GL_EQUAL show where the depth buffer already holds their depth. If no earlier draw left that depth with the
 * whole of the same body, they show a part of it that is not known from its geometry: what a solid is carved to by
 * others (constructive solid geometry in the depth buffer, Goldfeather et al. 1989, "Near Real-Time CSG Rendering Using
 * Tree Normalization and Geometric Pruning"), or what a decal is cut to. The rest of the body is nowhere, so it stops
 * no light. What left the depth does, as any other draw.
 */
#pragma once

#include "scene/scene.h"

/**
 * @param bits  [n_instances]: receives SCENE_FILM
 * @return how many instances there are
 */
uint32_t carved_find(const struct scene *scene, uint32_t *bits);
