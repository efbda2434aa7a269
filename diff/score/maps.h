/* Maps for the colour gates: differences, edges, failing pixels. */
#pragma once

#include "diff/score/score.h"

/** Per-pixel differences, which reports also show. All: [height][width]. */
struct score_maps {
	uint8_t *difference; /* largest channel difference, codes */
	uint8_t *residual;   /* remaining difference after R2's symmetric minimum over 3x3 pixels, codes */
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
