/*
 * Draws under GL_EQUAL appear where the depth buffer already holds their depth. If no earlier draw of the whole body
 * wrote that depth, only a part of the body is visible, and its geometry does not tell which: a solid carved by
 * others (constructive solid geometry in the depth buffer, Goldfeather et al. 1989, "Near Real-Time CSG Rendering
 * Using Tree Normalization and Geometric Pruning"), or the outline of a decal. The rest of the body does not exist,
 * so it blocks no light. The draw that wrote the depth blocks light as usual.
 */
#pragma once

#include "scene/scene.h"

/**
 * @param bits  [n_instances]: receives SCENE_FILM
 * @return the number of instances found
 */
uint32_t carved_find(const struct scene *scene, uint32_t *bits);
