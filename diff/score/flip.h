/* FLIP and HDR-FLIP: perceived difference of two pictures when flipped between. */
#pragma once

#include <stdint.h>

/** Pixels per degree at 0.7 m from a display 3840 px and 0.7 m wide. */
#define FLIP_PIXELS_PER_DEGREE 67.0206432f

/**
 * Perceived difference of two pictures when flipped between (Andersson et al., "FLIP: A Difference Evaluator for
 * Alternating Images", HPG 2020).
 *
 * @param a, b   [height][width][3], codes (sRGB)
 * @param error  receives [height][width], [0,1]; NULL: compute only the mean
 * @param mean   receives the mean
 * @return 0 or ERR_SYSTEM (reported)
 */
int flip_compare(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, float *error, double *mean);

/**
 * FLIP for linear pictures of any range: the largest error over four exposures from 2^0.083 to 2^3.557 of a film curve
 * (Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021). The exposures are
 * fixed, whereas the authors derive them from the reference: frames stay comparable, and black ones have a score.
 *
 * @param a, b   planes R, G, B of linear Rec.709, [height][width] each
 */
int flip_compare_hdr(const float *const a[3], const float *const b[3], uint32_t width, uint32_t height, float *error,
                     double *mean);

/** Colour of a value in [0,1] on the map "magma" (matplotlib), as codes. */
void flip_magma(float value, uint8_t rgb[3]);
