/* Skies: surfaces drawn before everything else, and farther away than everything else. */
#pragma once

#include <stdint.h>

struct scene;

/**
 * Find the instances that are skies. A sky is drawn in perspective, before anything of its eye space that leaves colour
 * and depth, and leaves no depth itself, so everything else seen is in front of it. A backdrop leaves no depth either,
 * as a clear drops it (scene/backdrop.h). Draws that colour a depth pre-pass are not skies (scene/depths.h). After a
 * clear of the window's depth, skies may follow again.
 * @param skies  [n_instances], all 0; receives 1 for each
 * @return 0; -1: out of memory
 */
int scene_find_skies(const struct scene *scene, uint8_t *skies);
