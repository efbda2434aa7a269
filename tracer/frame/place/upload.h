/* Uploads a scene's meshes, state, textures and trees to the device. Functions return 0 or ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/** Upload attributes or indices of the frame's meshes to the pools, and set their offsets in the geometries. */
int upload_attributes(struct job *job);
int upload_indices(struct job *job);

/** Upload materials, lights, texture units, textures, current values, stipples and programs. */
int upload_state(struct job *job);

/** Upload the trees of accel_build_frame that the device's kernels traverse. Mesh trees are uploaded only if they
 * changed. */
int upload_trees(struct job *job);
