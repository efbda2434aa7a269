/* Describes one surface of a frame in text. */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/**
 * Write an instance's draw, call, mesh, textures and material, a line each.
 * @param before  prefix of each line
 */
void scene_describe(FILE *out, const struct scene *scene, uint32_t instance, const char *before);
