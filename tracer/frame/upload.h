/* What of a scene the device needs: meshes, state, textures, trees. Functions return 0 or ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/frame.h"

/** Attributes and indices of the frame's meshes into the pools, and their places into the geometries. */
int upload_attributes(struct job *job);
int upload_indices(struct job *job);

/** Materials, lights, texture units and textures, current values, stipples, programs. */
int upload_state(struct job *job);

/** What accel_build_frame made and the device's kernels walk; the trees of meshes only where they changed. */
int upload_trees(struct job *job);
