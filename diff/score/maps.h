/* Per-pixel maps that the colour gates count: differences, edges, failing pixels. */
#pragma once

#include "diff/score/score.h"

/** The maps, each [height][width]. Reports show them, too. */
struct score_maps {
	uint8_t *difference; /* largest channel difference, codes */
	uint8_t *residual;   /* difference to the nearest of 3 x 3 pixels in the other picture; the larger of both
	                        directions, codes (R2, R3) */
	uint8_t *failing;    /* 1 where the pixel fails R1, R1b or R2 */
	uint8_t *band;       /* 1: edge band */
};

/**
 * Compute the maps behind gates R1 to R3 for two pictures of one size.
 * @param out  all zero; free with score_maps_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_make_maps(const struct score_picture *ref, const struct score_picture *traced,
                    const struct score_options *options, struct score_maps *out);
void score_maps_free(struct score_maps *maps);

/** 1 if all depths are steps of a 16-bit depth buffer. */
int score_depth_is_16_bit(const float *depth, size_t n);

/** Largest difference that R1 and R1b allow at a pixel, codes. */
double score_allowed(const struct score_options *options, const struct score_picture *traced, size_t i);

/** Number of blended layers at a pixel; 0 without the channel. */
float score_layers_at(const struct score_picture *traced, size_t i);
