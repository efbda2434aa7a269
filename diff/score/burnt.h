/*
 * Gate N, its third figure: does light burn out what OpenGL shows in colour?
 *
 * A pixel is burnt where a channel is full and the surface's own colour is washed out: the least channel has a larger
 * share of the greatest than in albedo, by a quarter and 0.05, or both are full. A surface of full red in full light
 * keeps its colour, and is none. Highlights are burnt in OpenGL's picture, too, and a lamp that moves takes them along.
 * What counts is how many pixels are burnt in light (gl x shadow + relight, so what mirrors and glass show is none) and
 * were not in gl, by at least 16 codes, beyond those that were and are no longer. Bar: 1 % of the frame. Lamps beside
 * heads and models: 0 to 0.4 %; a lamp that was a third too strong 2.0 and 5.4 %.
 */
#pragma once

#include "diff/score/gates.h"

/** @return the share of the frame's pixels, 0 where there is no relight; they are blamed where it is above 0 */
double burnt_share(const struct gate_frame *f);
