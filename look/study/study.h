/*
 * A study of a recording: it takes scene after scene and finds rules (look/rules/findings.h).
 *
 * motion.h finds the camera and what moves; the other files rely on it to interpret what was drawn.
 */
#pragma once

#include <stdint.h>

#include "look/rules/findings.h"
#include "scene/scene.h"

struct study;

/** @return 0 or ERR_SYSTEM (reported) */
int study_create(struct study **out);
void study_destroy(struct study **study);

/** The largest number of frames that a study takes. */
uint64_t study_most_frames(void);

/**
 * Study one more frame.
 * @param scene  later than the last one; not kept
 * @return 0 or ERR_SYSTEM (reported)
 */
int study_add(struct study *study, const struct scene *scene);

/** Solve for lights, after the last frame. @return 0 or ERR_SYSTEM (reported) */
int study_finish(struct study *study);

/**
 * Find the rules, each with its role, confidence and reason.
 * @param out  empty; call findings_free even on failure
 * @return 0 or ERR_SYSTEM (reported)
 */
int study_find(const struct study *study, struct findings *out);
