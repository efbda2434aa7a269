/*
 * Which pixels of a surface are known without what was there before: those that clears have reached, by buffer. Whole
 * clears are a bit; clears of parts (one viewport of several, a corner that becomes a texture) are kept as rectangles,
 * as far as there is room. What finds no room counts as not known.
 */
#pragma once

#include <stdint.h>

#define GLS_KNOWN_PARTS 16

/* All zero: nothing is known. */
struct gls_known {
	uint32_t whole; /* buffers, bits as in scene_clear */
	uint32_t n[3];  /* of parts, of each buffer */
	int32_t parts[3][GLS_KNOWN_PARTS][4]; /* x, y, width, height */
};

/**
 * A clear.
 * @param buffers  that it sets whatever they held
 * @param all      the surface's width and height
 * @param part     x, y, width, height of what it reaches
 */
void gls_known_clear(struct gls_known *k, uint32_t buffers, const uint32_t all[2], const int32_t part[4]);

/** Those of `buffers` that are not known in all of a rectangle (x, y, width, height); an empty one is known. */
uint32_t gls_known_lacks(const struct gls_known *k, uint32_t buffers, const int32_t part[4]);
