/*
 * The surfaces of a frame that let all light pass, found before rays to lights are traced (kernels/rays/opacity.h):
 * whole instances, sides of triangles, and, where a texture decides, cells of triangles in maps. Maps depend on meshes,
 * textures and materials, and are kept on the device from frame to frame.
 */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Set the instances' opacity and upload their words. The instances' places, meshes and trees must be known.
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int opacity_place(struct frame *frame);
