/* Keys of a rule that match one surface of a frame and no other. */
#pragma once

#include <stddef.h>

#include "scene/scene.h"

enum { ALONE_BYTES = 256 };

/**
 * Find keys of `match` that single out an instance. The most durable come first: its texture, its mesh, both
 * together, its display list. If other instances share all of these, the draw number is used, which applies to this
 * frame alone.
 * @param keys  receives them as YAML: { mesh: "90c2..." }
 * @return 0: the keys match no other instance; above 0: the draw number was needed, and this many other instances share
 * the remaining keys; ERR_SYSTEM (reported)
 */
int alone_find(const struct scene *scene, uint32_t instance, char keys[ALONE_BYTES]);
