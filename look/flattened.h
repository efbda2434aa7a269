/*
 * Shadows that a program draws by flattening a body onto a plane. The matrix that does it holds the light and the plane
 * exactly.
 */
#pragma once

#include "scene/scene.h"

/** 1 where an instance may be one: flat, and unlit or in the stencil buffer alone. */
int flattened_may_be(const struct scene *scene, const struct scene_instance *in);

/**
 * The light and the plane of a shadow, by what takes an upright draw's body to a flat one's.
 * @param light  in eye space; w 0: a direction towards it
 * @param plane  p . (x y z 1) = 0 in eye space, its normal a unit vector towards what is seen
 * @return 0: the flat draw is none of its shadows
 */
int flattened_from(const struct scene *scene, uint32_t flat, uint32_t upright, double light[4], double plane[4]);

/** How far apart two lights are, over how far they are from the origin; of directions the angle. */
double flattened_apart(const double a[4], const double b[4]);

/**
 * 1 where most of what is drawn (at a plane, or at all where it is NULL) is lit by a light of OpenGL's at this place:
 * traced shadows of that light fall there.
 * @param light, plane  in eye space
 */
int flattened_is_lit(const struct scene *scene, const double light[4], const double *plane);

/**
 * See to it in one frame that nothing throws two shadows. A drawn shadow of a light of OpenGL's gives way to the traced
 * one. Of another light, or through the stencil buffer, it stays, and its body stops no light.
 * @param gives_way  0: it stays in any case
 * @param bits       [n_instances]: receives SCENE_LEFT_OUT or SCENE_HIDDEN_FROM_LIGHTS
 * @param n          grows by their number
 * @return 0 or ERR_SYSTEM (reported)
 */
int flattened_find(const struct scene *scene, int gives_way, uint32_t *bits, uint32_t *n);
