/*
 * Which frame draws what stands still: programs leave out what their viewer does not see, and mirrors and shadows need
 * it all the same.
 */
#pragma once

#include "look/findings.h"
#include "look/study/motion.h"
#include "scene/scene.h"

/* All zero: nothing was seen. */
struct seen {
	struct seen_draw {
		uint32_t thing, draw, frame; /* motion.things; its draw number there; motion.cameras */
	} *draws;
	size_t n, room;
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int seen_add(struct seen *seen, const struct scene *scene, const struct motion *motion);
void seen_free(struct seen *seen);

/** The rules `unseen`: few frames that draw between them all that stands still and some frames leave out. @return 0 or
 * ERR_SYSTEM (reported) */
int seen_find(const struct seen *seen, const struct motion *motion, struct findings *out);
