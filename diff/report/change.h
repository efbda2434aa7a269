/* The difference between a frame and its approved version, for pictures. */
#pragma once

#include "diff/baseline/baseline.h"
#include "diff/score/picture.h"

struct change {
	struct image image;            /* the approved frame; no channels: none, or its pixels are not stored */
	struct score_picture was, now; /* beauty of the approved and the traced frame; rgb NULL: none */
	uint8_t *off; /* [height][width] of both: 1 where gate B sees a change; NULL: sizes differ, or unchanged */
};

/**
 * Find the approved frame of a traced one.
 * @param ignore  [height][width]: 1 where nothing is compared; NULL: compare everywhere
 * @param out     all zero; free with change_free in any case
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int change_find(const struct baseline *baseline, const struct image *traced, uint64_t frame, const uint8_t *ignore,
                struct change *out);
void change_free(struct change *change);
