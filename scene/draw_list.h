/* Draw numbers of some of a frame's instances as text, as attributes of pictures name them. */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

/** 1 where instance i of the scene is one of them. */
typedef int scene_draw_chooser(const void *user, const struct scene *scene, uint32_t i);

/** @return ranges as base/frames.h parses them; "": none of them; NULL: out of memory. To be freed */
char *scene_draw_list(const struct scene *scene, scene_draw_chooser *is, const void *user);
