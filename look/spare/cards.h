/* Crossed cards: flat cut-outs that pass through each other, for trees, bushes and fires. */
#pragma once

#include "scene/scene.h"

/**
 * Find instances with crossed cards: at least half of their rectangles cross a neighbour.
 * @param bits   [n_instances]: these instances get this bit
 * @param count  receives their number
 * @return 0 or ERR_SYSTEM (reported)
 */
int cards_find(const struct scene *scene, uint32_t bit, uint32_t *bits, uint32_t *count);
