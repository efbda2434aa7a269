/*
 * Which draws of two frames are one: by mesh and number (look/followed.h), then crowds (crowds.h) and what deforms
 * (deforming.h); and the motion of the camera, which more than half of the opaque things share, by size.
 */
#pragma once

#include "look/between/bridge.h"

/** Fill a bridge. @return 0 or ERR_SYSTEM (reported): bridge_end all the same */
int couples_find(struct bridge *b, const struct scene *base, const struct scene *other, int is_back);
