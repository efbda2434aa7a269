/*
 * The pixels of a surface that do not depend on earlier contents, by buffer: those that clears have covered. A complete
 * clear is a bit; partial clears (one viewport of several, a corner that becomes a texture) are kept as rectangles
 * while there is room. The rest counts as unknown.
 */
#pragma once

#include <stdint.h>

#define GLS_KNOWN_PARTS 16

/* All zero: nothing is known. */
struct gls_known {
	uint32_t whole; /* buffers known completely, bits as in scene_clear */
	uint32_t n[3];  /* number of parts, by buffer */
	int32_t parts[3][GLS_KNOWN_PARTS][4]; /* x, y, width, height */
};

/**
 * Note a clear.
 * @param buffers  buffers that it sets completely, whatever they held
 * @param all      the surface's width and height
 * @param part     x, y, width, height of the area it covers
 */
void gls_known_clear(struct gls_known *k, uint32_t buffers, const uint32_t all[2], const int32_t part[4]);

/**
 * The members of `buffers` that are not known everywhere in a rectangle (x, y, width, height); an empty one is known.
 */
uint32_t gls_known_lacks(const struct gls_known *k, uint32_t buffers, const int32_t part[4]);
