/*
 * Light by way of mirrors and glass onto matte surfaces: caustics, as channels caustics.R, G and B.
 *
 * Photons go from each light to each thing that mirrors or bends, many passes of them. A pixel's point gathers those
 * that came to within a radius, which shrinks from pass to pass, and passes are averaged: the mean tends to the truth
 * (C. Knaus and M. Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", 2011). OpenGL's lights need not
 * weaken with distance, so a photon is worth what makes an open way as bright as OpenGL has it: colour x attenuation x
 * length^2, for each steradian.
 *
 * Left out: light that a matte surface scattered before, that of surfaces that shine, and alpha and blending on the
 * way.
 */
#pragma once

#include "tracer/frame/frame.h"

/**
 * Add the channels to a frame that was rendered whole and is still on the device.
 * @param img  with channels N, P and albedo
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int photons_add(struct job *job, struct image *img);
