/* Describes the effect of rules on a frame, for reports. */
#pragma once

#include "look/rules/rules.h"
#include "scene/scene.h"

/**
 * Pass one line of text for each role that rules give in a frame: "surface", its role, confidence, draw numbers
 * ("3-7,12", cut off if there are too many) and reason, separated by tabs. For a light: "light", and its position in
 * eye space.
 * @param tell  called for each line; an error from it ends the calls
 * @return 0, tell's error, or ERR_SYSTEM (reported)
 */
int look_tell(const struct look *look, const struct scene *scene, int (*tell)(void *user, const char *text),
              void *user);
