/* Prepares a moment's scene for the tracer: applies the rules, the size and the camera asked for. */
#pragma once

#include "look/between/between.h"
#include "look/camera/elsewhere.h"
#include "look/camera/scaled.h"
#include "look/spare/spare.h"
#include "verbs/render/settings.h"

struct seen {
	const struct scene *recorded; /* as the program had it, or would have had it between two frames */
	const struct scene *scene;    /* the scene to trace: one of these */
	struct between between;
	struct scene whole, changed;
	struct spare found;
	struct scaled scaled;
	struct elsewhere elsewhere;
};

/**
 * @param seen    between may hold `recorded`; everything else is all zero. seen_release, also after an error
 * @param number  the picture's
 * @return 0; ERR_INPUT (reported): the camera's file is not for this frame; ERR_SYSTEM (reported)
 */
int seen_make(const struct settings *settings, uint64_t number, struct seen *seen);
void seen_release(struct seen *seen);
