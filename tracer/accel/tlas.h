/*
 * The TLASes (top levels) of one frame: trees over instances, one for the camera rays of each view, one for the
 * secondary rays of each eye space and one for its skies.
 */
#pragma once

#include "tracer/accel/accel.h"

/**
 * Make accel's top2, top8, instance_list and spaces.
 *
 * @param instances  [n]
 * @param boxes      [n]: of their meshes, object space
 * @param views      [scene->n_views]; tlas_first and tlas_count are filled in
 * @return 0 or ERR_SYSTEM (reported)
 */
int tlas_build(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
               const struct bvh_box *boxes, struct view *views);
