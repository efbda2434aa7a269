/*
 * Layers painted behind the world, found in a single frame: they are drawn before the world, hide nothing of it, and
 * surround the viewer. The viewer need not move.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

enum layer { LAYER_WORLD, LAYER_SKY, LAYER_UNKNOWN };

/**
 * The layer of each instance. LAYER_UNKNOWN is painted like a sky, but the frame contains too little of it to
 * surround the viewer.
 * @param out  enum layer, [n_instances]
 */
void layer_find(const struct scene *scene, uint8_t *out);
