/*
 * Several pictures of one frame that should be the same. What differs between them is noise; what is wrong in all of
 * them alike is not.
 *
 * The composite takes for each pixel and channel the value nearest to the reference that lies within what the runs
 * showed: where the reference lies between them, the reference itself. Where runs disagree, a pixel's neighbours count
 * as what they showed: edges tremble. The reference is taken, too, where it is no further from what the runs showed
 * than these are from each other, and at single pixels that all runs show alike by chance: amid at least four times as
 * many that vary by as much. A gate that the composite fails, fails whatever the noise.
 */
#pragma once

#include "diff/score/picture.h"

struct composite_varying {
	uint64_t pixels;         /* that differ between runs by more than `codes` in a channel */
	uint32_t x0, y0, x1, y1; /* box around them, the last ones included */
};

/**
 * @param base    one of the runs; its compared layer and gl.depth are changed into the composite's
 * @param layer   the layer that is compared
 * @param ref     receives the codes of its pairs with the runs, as score_pair
 * @param ignore_alpha  as score_pair
 * @param images  all runs, base among them or not; those of another size than the reference are left out
 * @return 0 or ERR_SYSTEM (reported)
 */
int composite_make(struct image *base, const char *layer, struct score_picture *ref, const struct image *images,
                   size_t n, int codes, int ignore_alpha, struct composite_varying *varying);
