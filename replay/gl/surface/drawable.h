/* Windows and pbuffers. */
#pragma once

#include <stdint.h>

#include "replay/build/frame.h"

#define GLS_MAX_DRAWABLE 65536 /* pixels of a side */

/* A window or pbuffer as far as the trace tells. */
struct gls_drawable {
	uint32_t width, height;
	int fixed; /* size said by the recorder (relume:drawable) and not guessed from viewports */
	struct gls_surface surface; /* the back buffer, or the only one */
	struct gls_surface front;   /* of two; without events while it has not parted (front.c) */
	int parted;                 /* 1: both get every event */
	int16_t *accum; /* owned: the accumulation buffer, [height][width][4], see accum.c; NULL: all 0 */
	uint32_t accum_width, accum_height;
	uint32_t accum_missing; /* 1: it was changed in a frame that was skipped */
};

/** The drawable of this name, made where there is none; NULL: out of memory. */
struct gls_drawable *gls_drawable_of(struct gls_exec *x, uint64_t name);
