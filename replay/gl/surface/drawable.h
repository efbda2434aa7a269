/* Windows and pbuffers. */
#pragma once

#include <stdint.h>

#include "replay/build/frame.h"

#define GLS_MAX_DRAWABLE 65536 /* pixels per side */

/* A window or pbuffer, as far as the trace describes it. */
struct gls_drawable {
	uint32_t width, height;
	int fixed; /* 1: the recorder gave the size (relume:drawable); 0: it is guessed from viewports */
	struct gls_surface surface; /* the back buffer, or the only one */
	struct gls_surface front;   /* the front buffer beside a back buffer; without events while not separate (front.c) */
	int parted;                 /* 1: separate, so both get every event */
	int16_t *accum; /* owned: the accumulation buffer, [height][width][4], see accum.c; NULL: all 0 */
	uint32_t accum_width, accum_height;
	uint32_t accum_missing; /* 1: a skipped frame changed it */
};

/** The drawable of this name, created if necessary; NULL: out of memory. */
struct gls_drawable *gls_drawable_of(struct gls_exec *x, uint64_t name);
