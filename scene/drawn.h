/* Finds the instance of a draw. */
#pragma once

#include "scene/scene.h"

/**
 * The last instance that begins at or before a draw; instances are sorted by draw.
 * @return its index, or SCENE_NONE
 */
uint32_t scene_instance_of(const struct scene *scene, uint32_t draw);
