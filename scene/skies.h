/* What is drawn before all else, and stands farther away than all else. */
#pragma once

#include <stdint.h>

struct scene;

/**
 * Which instances are skies: drawn in perspective before anything of their eye space that leaves depth, and leaving none themselves, so
 * that all else is in front of them. Depth that is cleared before the world is drawn is none (scene/backdrop.h).
 * @param skies  [n_instances], all 0; receives 1 for each
 * @return 0; -1: out of memory
 */
int scene_find_skies(const struct scene *scene, uint8_t *skies);
