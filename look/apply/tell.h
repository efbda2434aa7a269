/* What rules say of a frame, for the reader of a report. */
#pragma once

#include "look/rules.h"
#include "scene/scene.h"

/**
 * Tell of each role that rules give in a frame, one line of text each: "surface", its role, confidence, draw
 * numbers ("3-7,12", cut off where they are too many) and why, with tabs between them. Of a light: "light", and its
 * place in eye space.
 * @param tell  called for each; ends the telling where it returns an error
 * @return 0, tell's error, or ERR_SYSTEM (reported)
 */
int look_tell(const struct look *look, const struct scene *scene, int (*tell)(void *user, const char *text),
              void *user);
