/* Describes one surface of a frame in text, for people who write rules for it. */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/**
 * Write an instance's draw, call, mesh, textures and material, a line each.
 * @param prefix  starts each line: "# " or ""
 */
void scene_describe(FILE *out, const struct scene *scene, uint32_t instance, const char *prefix);
