/* Describes the effect of rules on a frame, for the attributes relume:rule.N of its picture. */
#pragma once

#include "look/rules/rules.h"
#include "scene/scene.h"

/**
 * Describe the findings of a look's rules in a frame, one line each. Five fields are separated by tabs: "surface" or
 * "light", role, confidence, detail and reason. Lines longer than 249 bytes are cut off.
 *
 * A surface's detail is the numbers of its draws ("3-7,12", as many ranges as fit); a role found on no draw has no
 * line. A repaired mesh is a surface too; its role says whether the mesh is closed, and its detail is one draw. A
 * light's detail is its position in eye space, "x y z w", or empty: the sky and highlights have none.
 *
 * @param tell  called with each line, which it must copy; an error from it ends the calls
 * @return 0, tell's error, or ERR_SYSTEM (reported)
 */
int look_tell(const struct look *look, const struct scene *scene, int (*tell)(void *user, const char *text),
              void *user);
