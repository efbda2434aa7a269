/*
 * What a program paints behind its world, told by one frame: drawn before the world, so that it hides nothing of it,
 * and all around the viewer. The viewer need not move for that.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

enum layer { LAYER_WORLD, LAYER_SKY, LAYER_UNKNOWN };

/**
 * What each instance is: LAYER_UNKNOWN is painted as a sky is, but too little of that is in the frame to be all around.
 * @param out  enum layer, [n_instances]
 */
void layer_find(const struct scene *scene, uint8_t *out);
