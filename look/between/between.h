/*
 * The scene at a moment between two recorded frames. Draws that show one thing in both (bridge.h) move as bodies do
 * (pose.h); OpenGL's numbers change linearly (mixed.h). One of the frames is the base: a draw without a partner appears
 * if it is the base's, and goes with the camera. Pixel rectangles, textures and switches are the base's, and so are
 * draws without depth unless they do not move or go with the camera: texts are never mixed.
 *
 * The camera's motion is the one that more than half of the opaque things share, by size. Other motions are taken
 * relative to it: a thing that the camera carries keeps its place in the picture, and a wheel turns about its own axis.
 *
 * A cut is not bridged: if less than half of the surface that one of the frames shows is in the other one, at most half
 * the picture away, there is no scene between them.
 */
#pragma once

#include "scene/scene.h"

/* The time between two frames: what all its moments share. */
struct interval;

/**
 * @param first, second  scenes of frames, in order of time; they outlive the interval
 * @return NULL: no memory (reported). Threads may share it.
 */
struct interval *interval_new(const struct scene *first, const struct scene *second);
void interval_free(struct interval **interval);

/** 1 if a cut separates the two. */
int interval_is_cut(const struct interval *interval);

struct between {
	struct scene scene; /* borrows what has not changed from both frames */
	uint32_t n_matched, n_alone; /* draws with a partner and without; pixel rectangles are not counted */
	void **owned;
	size_t n_owned;
};

/**
 * @param interval  no cut
 * @param at        (0,1): 0 is the first frame
 * @param base      0: the first frame; 1: the second
 * @param out       between_release before the scenes are
 * @return 0 or ERR_SYSTEM (reported)
 */
int between_make(const struct interval *interval, double at, int base, struct between *out);
void between_release(struct between *between);
