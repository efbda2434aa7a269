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
 * @return the number of other instances that the keys match apart from `draws`; 0 if that key is absent; ERR_SYSTEM
 * (reported)
 */
int alone_find(const struct scene *scene, uint32_t instance, char keys[ALONE_BYTES]);
