/* What is drawn before all else, and stands farther away than all else. */
#pragma once

#include <stdint.h>

struct scene;

/**
 * Which instances are skies: drawn in perspective before anything of their eye space that leaves colour and depth, and
 * leaving no depth themselves, so that all that is seen else is in front of them. A backdrop leaves none either: a
 * clear takes it (scene/backdrop.h). What colours a depth pre-pass is none (scene/depths.h). A clear of the window's
 * depth begins anew.
 * @param skies  [n_instances], all 0; receives 1 for each
 * @return 0; -1: out of memory
 */
int scene_find_skies(const struct scene *scene, uint8_t *skies);
