/*
 * Composite of several pictures of one frame that should be the same. Differences between them are noise; errors common
 * to all of them are not.
 *
 * For each pixel and channel the composite takes the value nearest to the reference within the range of the runs; if
 * the reference lies in that range, this is the reference itself. Where runs disagree, the range includes the pixel's
 * neighbours, as edges shift by a pixel. The reference is also taken where its distance from the range is no larger
 * than the range itself, and at single pixels that are off in all runs by chance: at least four times as many pixels
 * around them vary by as much. If a gate fails on the composite, the cause is not noise.
 */
#pragma once

#include "diff/score/picture.h"

struct composite_varying {
	uint64_t pixels;         /* number that differ between runs by more than `codes` in a channel */
	uint32_t x0, y0, x1, y1; /* their bounding box, inclusive */
};

/**
 * Turn `base` into the composite.
 * @param base    one of the runs; its compared layer and gl.depth are replaced by the composite's
 * @param layer   the layer to compare
 * @param ref     receives the codes of its pairs with the runs, as in score_pair
 * @param ignore_alpha  as in score_pair
 * @param images  all runs, with or without base; those of another size than the reference are ignored
 * @return 0 or ERR_SYSTEM (reported)
 */
int composite_make(struct image *base, const char *layer, struct score_picture *ref, const struct image *images,
                   size_t n, int codes, int ignore_alpha, struct composite_varying *varying);
