/*
 * Draws of two frames that show the same thing: matched by mesh and number (look/draws/followed.h), then in crowds
 * (crowds.h), then deforming ones (deforming.h). Also the motion of the camera, shared by more than half of the
 * opaque surfaces, by size.
 */
#pragma once

#include "look/between/bridge.h"

/** Fill a bridge. @return 0 or ERR_SYSTEM (reported); call bridge_end in any case */
int couples_find(struct bridge *b, const struct scene *base, const struct scene *other, int is_back);
