/* Prepares the scene of a moment for the tracer: applies the rules, the requested size and the requested camera. */
#pragma once

#include "look/between/between.h"
#include "look/camera/elsewhere.h"
#include "look/camera/scaled.h"
#include "look/spare/spare.h"
#include "verbs/render/settings.h"

struct seen {
	const struct scene *recorded; /* as the program had it, or would have had it between two frames */
	const struct scene *scene;    /* the scene to trace: the last of the steps below that were needed */
	struct between between;       /* interpolated between two frames */
	struct scene whole;           /* with static things that the frame omits (look/apply/unseen.h) */
	struct scene changed;         /* with the rules applied */
	struct spare found;           /* surfaces that let light pass, found by the rules */
	struct scaled scaled;         /* in a window of another size */
	struct elsewhere elsewhere;   /* from another camera */
};

/**
 * Prepare a scene.
 * @param seen    `recorded` is set, and `between` if it holds that scene; everything else is zero. seen_release, also
 *                after an error
 * @param number  the picture's number in file names
 * @return 0; ERR_INPUT (reported): the camera's file is not for this frame; ERR_SYSTEM (reported)
 */
int seen_make(const struct settings *settings, uint64_t number, struct seen *seen);
void seen_release(struct seen *seen);
