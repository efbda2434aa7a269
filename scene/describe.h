/* What is known of one surface of a frame, as lines for people. */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/**
 * Write an instance's draw, call, mesh, textures and material, a line each.
 * @param before  what each line begins with
 */
void scene_describe(FILE *out, const struct scene *scene, uint32_t instance, const char *before);
