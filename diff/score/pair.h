/*
 * Codes of a pair of pictures, which depend on what both files can hold.
 *
 *   alpha    Compared if both have it; between pictures from other programs also if only one has it, the other then
 *            being opaque. Colours are multiplied by alpha unless their files store them so (OpenEXR does), as colours
 *            behind alpha 0 are invisible. A frame and its reference are framebuffers: alpha is not compared if one
 *            lacks it.
 *   range    Between two pictures in linear light, values below black and over white have codes beyond 0 and 255. Over
 *            white, a code is a constant ratio, that of sRGB's curve at white (0.9 %): halves and floats of the same
 *            light differ by less than one. A display picture ends at white, and the picture compared with it is
 *            clamped likewise.
 */
#pragma once

#include "diff/score/picture.h"

/**
 * Compute the codes of a pair. Pictures without known numbers, or of two sizes, are unchanged.
 * @param ignore_alpha  1: alpha is not compared, and colours are compared as stored
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_pair(struct score_picture *a, struct score_picture *b, int ignore_alpha);

/** Colour value number `at` ([height][width][3]) as a code, not clamped if the pair has such codes. */
int score_code_at(const struct score_picture *picture, size_t at);

/** The number of a code: in linear light, or as displayed if is_display. */
float score_number_of(int code, int is_display);

/** Difference of pixel i of a from pixel j of b: the largest of the colours and alpha, codes, at most 255. */
int score_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j);

/** As score_difference, of alpha only. */
int score_alpha_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j);
