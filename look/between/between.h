/*
 * The scene at a moment between two recorded frames. Draws that show one thing in both (bridge.h) move as bodies do
 * (pose.h); OpenGL's numbers change linearly (mixed.h). A draw without a partner appears if its frame is the nearer
 * one, and goes with the camera. Pixel rectangles, textures and switches are the nearer frame's, and so are draws
 * without depth unless they do not move or go with the camera: texts are never mixed.
 *
 * The camera's motion is the one that more than half of the opaque things share, by size. Other motions are taken
 * relative to it: a thing that the camera carries keeps its place in the picture, and a wheel turns about its own axis.
 *
 * A cut is not bridged: if less than half of the surface that a frame shows is in view in the other one, the scene is
 * that of the nearer frame.
 */
#pragma once

#include "scene/scene.h"

struct between {
	struct scene scene; /* borrows what has not changed from both frames */
	uint32_t n_matched, n_alone; /* draws with a partner and without; pixel rectangles are not counted */
	int is_cut;
	void **owned;
	size_t n_owned;
};

/**
 * @param first, second  scenes of frames, in order of time
 * @param at             (0,1): 0 is the first
 * @param out            between_release before the scenes are
 * @return 0 or ERR_SYSTEM (reported)
 */
int between_make(const struct scene *first, const struct scene *second, double at, struct between *out);
void between_release(struct between *between);
