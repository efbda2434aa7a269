/*
 * The frames that draw each static thing. Programs skip things out of the viewer's sight, but mirrors and shadows
 * need them.
 */
#pragma once

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"
#include "scene/scene.h"

/* All zero: empty. */
struct seen {
	struct seen_draw {
		uint32_t thing, draw, frame; /* index in motion.things; draw number in that frame; index in
		                                motion.cameras */
	} *draws;
	size_t n, room;
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int seen_add(struct seen *seen, const struct scene *scene, const struct motion *motion);
void seen_free(struct seen *seen);

/**
 * The rules `unseen`: a few frames that together draw all static things missing from some frames. @return 0 or
 * ERR_SYSTEM (reported)
 */
int seen_find(const struct seen *seen, const struct motion *motion, struct findings *out);
