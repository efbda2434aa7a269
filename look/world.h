/* Where the world is in a frame, by meshes that stand still in it (rules.h: `world`). */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct rules;

/** 1 where a hash begins with a text of hex digits. */
int world_hash_begins(const uint64_t hash[2], const char *text);

/**
 * The matrix that leads from the world into eye space. Each anchor that the frame draws says one; what most of them say
 * counts.
 * @param part  receives the recording's part that this is the world of; or NULL
 * @return 1; 0: the frame draws no anchor, or there is none
 */
int world_find(const struct rules *rules, const struct scene *scene, float eye_from_world[16], uint32_t *part);
