/* The keys by which a rule matches one surface of a frame, and no other. */
#pragma once

#include <stddef.h>

#include "scene/scene.h"

enum { ALONE_BYTES = 256 };

/**
 * Find the keys of `match` that single out an instance: those that hold longest first, its texture, then its mesh, then
 * both, then its display list; where all of these are shared, its draw number, which holds in this frame alone.
 * @param keys  receives them as YAML: { mesh: "90c2..." }
 * @return how many other instances of the frame the keys but `draws` match, which is 0 where there is no such key;
 * ERR_SYSTEM (reported)
 */
int alone_find(const struct scene *scene, uint32_t instance, char keys[ALONE_BYTES]);
