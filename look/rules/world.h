/* The place of the world in a frame, from meshes that stand still in it (rules.h: `world`). */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct rules;

/** 1 if a hash starts with the given hex digits. */
int world_hash_begins(const uint64_t hash[2], const char *text);

/**
 * Find the matrix from the world to eye space. Each anchor in the frame gives one, and the majority decides.
 * @param part  NULL, or receives the part of the recording that the world belongs to (rules.h: `part`)
 * @return 1; 0: the rules have no anchor, or the frame draws none; then nothing is set
 */
int world_find(const struct rules *rules, const struct scene *scene, float eye_from_world[16], uint32_t *part);
