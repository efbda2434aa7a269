/*
 * A recording, studied: scene after scene goes in, findings (look/findings.h) come out.
 *
 * motion.h finds the camera and what moves; the other files look at what was drawn in its light.
 */
#pragma once

#include <stdint.h>

#include "look/findings.h"
#include "scene/scene.h"

struct study;

/** @return 0 or ERR_SYSTEM (reported) */
int study_create(struct study **out);
void study_destroy(struct study **study);

/** How many frames a study takes. */
uint64_t study_most_frames(void);

/**
 * Study one more frame.
 * @param scene  of a later frame than the last; nothing of it is kept
 * @return 0 or ERR_SYSTEM (reported)
 */
int study_add(struct study *study, const struct scene *scene);

/** After the last frame: solve for lights. @return 0 or ERR_SYSTEM (reported) */
int study_finish(struct study *study);

/**
 * Find the rules, each with its role, its confidence and why.
 * @param out  empty; findings_free in any case
 * @return 0 or ERR_SYSTEM (reported)
 */
int study_find(const struct study *study, struct findings *out);
