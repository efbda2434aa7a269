/* Vertices and trees of a frame. */
#pragma once

#include "tracer/frame/frame.h"

/**
 * Run the vertex stage, make triangles of lines and points, build the frame's trees; all of it on the device. Needs upload_state.
 * @return 0 or ERR_SYSTEM (reported)
 */
int geometry_place(struct job *job);
