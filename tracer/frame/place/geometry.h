/* The vertices and trees of a frame. */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Run the vertex stage, expand lines and points to triangles, and build the frame's trees, all on the device. Call
 * after upload_state.
 * @return 0 or ERR_SYSTEM (reported)
 */
int geometry_place(struct frame *frame);

/** 1 if geometry_move can replace geometry_place for another pass: no lines or points, one sample per pixel. */
int geometry_can_move(const struct frame *frame);

/**
 * After prepare_shift, upload the views of a placed frame and move its vertices in their windows.
 * @return 0 or ERR_SYSTEM (reported)
 */
int geometry_move(struct frame *frame);
