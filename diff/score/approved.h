/* Where a traced frame is not the approved one. */
#pragma once

#include "diff/score/score.h"

/**
 * Mark pixels where a layer of colour differs by more than other builds of a device's compiler explain.
 * @param was  the approved frame, of the same size
 * @param off  [height][width]; receives 1 at each of them, and keeps what it has elsewhere
 */
void approved_mark(const struct image *now, const struct image *was, uint8_t *off);
