/*
 * Shadows that a program draws by flattening a body onto a plane. The flattening matrix gives the light and the plane
 * exactly.
 */
#pragma once

#include "scene/scene.h"

/** 1 if an instance may be such a shadow: flat, and either unlit or drawn into the stencil buffer alone. */
int flattened_may_be(const struct scene *scene, const struct scene_instance *in);

/**
 * Find the light and the plane of a shadow from the matrix that takes an upright draw to a flat one.
 * @param light  in eye space; w 0: a direction towards it
 * @param plane  p . (x y z 1) = 0 in eye space; its normal is a unit vector towards the visible side
 * @return 0: the flat draw is not its shadow
 */
int flattened_from(const struct scene *scene, uint32_t flat, uint32_t upright, double light[4], double plane[4]);

/** The distance between two lights, relative to their distance from the origin; for directions, their angle. */
double flattened_apart(const double a[4], const double b[4]);

/**
 * 1 if a light of OpenGL's at this position lights most of what is drawn (on a plane, or anywhere if it is NULL), so
 * that its traced shadows fall there.
 * @param light, plane  in eye space
 */
int flattened_is_lit(const struct scene *scene, const double light[4], const double *plane);

/**
 * Make sure that nothing in a frame casts two shadows. A drawn shadow of a light of OpenGL's gives way to the traced
 * one. The shadow of another light, or one drawn through the stencil buffer, stays, and its body blocks no light.
 * @param gives_way  0: drawn shadows stay in any case
 * @param bits       [n_instances]: receives SCENE_LEFT_OUT or SCENE_HIDDEN_FROM_LIGHTS
 * @param n          increased by the number of instances
 * @return 0 or ERR_SYSTEM (reported)
 */
int flattened_find(const struct scene *scene, int gives_way, uint32_t *bits, uint32_t *n);
