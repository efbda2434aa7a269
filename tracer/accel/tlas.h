/*
 * The TLASes (top level acceleration structures) of one frame. They are trees over instances: one for the camera rays
 * of each view, and for each eye space one for secondary rays and one for skies.
 */
#pragma once

#include "tracer/accel/accel.h"

/**
 * Build accel's top2, top8, instance_list and spaces.
 *
 * @param instances  [n]
 * @param boxes      [n]: boxes of their meshes, object space
 * @param views      [scene->n_views]; receives tlas_first and tlas_count
 * @return 0 or ERR_SYSTEM (reported)
 */
int tlas_build(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
               const struct bvh_box *boxes, struct view *views);
