/*
 * Caustics: light that reaches matte surfaces through mirrors and glass, as channels caustics.R, G and B.
 *
 * In many passes, photons are sent from each light to each object that reflects or refracts. The point seen by a pixel
 * gathers those that land within a radius, which shrinks from pass to pass. The average over passes converges to the
 * true value (C. Knaus and M. Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", 2011). OpenGL's lights
 * need not weaken with distance, so photons are weighted to make an unobstructed path as bright as in OpenGL: colour x
 * attenuation x length^2 per steradian.
 *
 * Not included: light scattered by a matte surface before, light from emissive surfaces, and alpha and blending along
 * the path.
 */
#pragma once

#include "tracer/frame/common/frame.h"

/**
 * Add the channels to a completely rendered frame that is still on the device.
 * @param img  image with channels N, P and albedo
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int photons_add(const struct frame *frame, struct image *img);
