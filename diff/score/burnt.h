/*
 * Gate N, third figure: does light burn out surfaces that OpenGL shows in colour?
 *
 * A pixel is burnt if a channel is full and the surface's own colour is washed out: the ratio of its least to its
 * greatest channel exceeds 1.25 times that of the albedo, plus 0.05, or both channels are full. A fully red surface in
 * full light keeps its colour and is not burnt. Highlights are also burnt in OpenGL's picture, and move with a moving
 * lamp. The figure is therefore the number of pixels burnt in light (gl x shadow + relight, without mirrors and glass)
 * but not in gl, by at least 16 codes, less the number burnt only in gl. Bar: 1 % of the frame. Lamps beside heads and
 * models gave 0 to 0.4 %; a lamp a third too strong gave 2.0 and 5.4 %.
 */
#pragma once

#include "diff/score/gates.h"

/** @return the share of burnt pixels, 0 without relight; if above 0, they are blamed */
double burnt_share(const struct gate_frame *f);
