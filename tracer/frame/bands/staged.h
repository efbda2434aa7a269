/* Any frame, segment by segment: each stage runs for all fragments of a segment before the next stage. */
#pragma once

#include "tracer/frame/common/frame.h"

/** Always 1. */
int staged_suits(const struct pass *pass);

/** Draw the band into pass->image or pass->picture, or add it to the sums of earlier passes. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int staged_band(struct band *band);
