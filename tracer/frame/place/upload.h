/* Uploads a scene's meshes, state, textures and trees to the device. Functions return 0 or ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/** Upload attributes or indices of the frame's meshes to the pools, and set their offsets in the geometries. */
int upload_attributes(struct frame *frame);
int upload_indices(struct frame *frame);

/** Upload materials, lights, texture units, textures, current values, stipples and programs. */
int upload_state(struct frame *frame);

/** Upload the trees of accel_build_frame that the device's kernels traverse. Mesh trees are uploaded only if they
 * changed. */
int upload_trees(struct frame *frame);
