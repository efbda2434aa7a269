/*
 * The opacity of a frame's surfaces, found before rays to lights are traced (kernels/rays/opacity.h): some stop all
 * rays or let all pass; where a texture decides, triangles have maps. Maps depend on meshes, textures and materials,
 * and are kept on the device from frame to frame.
 */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Set the instances' opacity and upload their words. The instances' places, meshes and trees must be known.
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int opacity_place(struct frame *frame);

/** 1 if the device's kernels know what the surfaces of a space let pass. */
int opacity_is_known(const struct frame *frame, const struct accel_space *space);
