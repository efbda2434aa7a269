/* The ways to draw a band: one table. */
#pragma once

#include "tracer/frame/common/frame.h"

struct way {
	int (*suits)(const struct pass *pass); /* 1 if it can draw this pass of a placed frame */
	/* Draws the band into pass->image or pass->picture, or adds it to the sums. @return 0, ERR_MEMORY or ERR_SYSTEM
	 * (reported) */
	int (*draw)(struct band *band);
	uint32_t (*pixels)(const struct frame *frame); /* pixels in a band, unless options or memory say otherwise */
};

/** The quickest way that suits this pass of the frame. */
const struct way *way_of(const struct pass *pass);

/** Number of rows in a band, in whole tiles. */
uint32_t way_rows(const struct way *way, const struct frame *frame);
