/*
 * The scene at a moment between two recorded frames. Draws that show one thing in both (bridge.h) move like rigid
 * bodies (pose.h); OpenGL's numbers change linearly (mixed.h). One of the frames is the base: a draw without a
 * partner appears if it belongs to the base, and moves with the camera. Pixel rectangles, textures and switches are
 * the base's, and so are draws without depth unless they stand still or move with the camera: text is never mixed.
 *
 * The camera's motion is the one shared by more than half of the opaque surfaces, by size. Other motions are relative
 * to it: a thing that moves with the camera keeps its place in the picture, and a wheel turns about its own axis.
 *
 * Cuts are not bridged: if less than half of the surface in one of the frames also appears in the other, at most half
 * the picture away, there is no scene between them.
 */
#pragma once

#include "scene/scene.h"

/* Two frames, and everything that scenes between them share. */
struct interval;

/**
 * Match the draws of two frames.
 * @param first, second  scenes of frames, in order of time; they must outlive the interval
 * @return an interval, which threads may share; NULL: no memory (reported)
 */
struct interval *interval_new(const struct scene *first, const struct scene *second);
void interval_free(struct interval **interval);

/** 1 if a cut separates the two. */
int interval_is_cut(const struct interval *interval);

/* A scene between two frames. */
struct between {
	struct scene scene; /* borrows unchanged parts from both frames */
	uint32_t n_matched, n_alone; /* draws with a partner and without; pixel rectangles are not counted */
	void **owned; /* [n_owned]: further memory of the scene */
	size_t n_owned;
};

/**
 * Make the scene at a moment.
 * @param interval  without a cut
 * @param at        (0,1): 0 is the first frame
 * @param base      0: the first frame; 1: the second
 * @param out       call between_release before the scenes are released
 * @return 0 or ERR_SYSTEM (reported)
 */
int between_make(const struct interval *interval, double at, int base, struct between *out);
void between_release(struct between *between);
