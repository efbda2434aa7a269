/* Finds differences between a traced frame and the approved one. */
#pragma once

#include "diff/score/score.h"

/**
 * Mark pixels where a colour layer differs by more than another build of the device's compiler can explain.
 * @param was  the approved frame, of the same size
 * @param off  [height][width]; receives 1 at such pixels, and is unchanged elsewhere
 */
void approved_mark(const struct image *now, const struct image *was, uint8_t *off);
