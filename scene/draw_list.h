/* Draw numbers of chosen instances as text, in the form of a picture's attributes. */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

/** 1 if instance i of the scene is chosen. */
typedef int scene_draw_chooser(const void *user, const struct scene *scene, uint32_t i);

/** @return ranges as base/frames.h parses them, to be freed; "": none chosen; NULL: out of memory */
char *scene_draw_list(const struct scene *scene, scene_draw_chooser *is, const void *user);
