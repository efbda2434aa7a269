/* Vertices and trees of a frame. */
#pragma once

#include "tracer/frame/frame.h"

/**
 * Run the vertex stage, make triangles of lines and points, build the frame's trees; all of it on the device. Needs
 * upload_state.
 * @return 0 or ERR_SYSTEM (reported)
 */
int geometry_place(struct job *job);

/** Whether geometry_move can do what geometry_place does for another pass: no lines and points, one sample a pixel. */
int geometry_can_move(const struct job *job);

/**
 * Bring the views of a placed frame to the device after prepare_shift, and its vertices to where they are in their
 * windows.
 * @return 0 or ERR_SYSTEM (reported)
 */
int geometry_move(struct job *job);
