/*
 * Two pictures that are compared: what both can hold decides what their codes are.
 *
 *   alpha    Compared where both have it, and between pictures of others also where one has it: the other one is
 *            opaque. Colours are then multiplied by it, where their files do not hold them so (OpenEXR does): what is
 *            behind alpha 0 is not seen. A frame and its reference are framebuffers: alpha is not compared where one
 *            lacks it.
 *   range    Between two pictures of linear light, values below black and over white have codes beyond 0 and 255. Over
 *            white, a code is a constant ratio, that of sRGB's curve at white (0.9 %): halves and floats of the same
 *            light differ by less than one. A display picture ends at white, and so does what is compared with it.
 */
#pragma once

#include "diff/score/picture.h"

/**
 * Make the codes of a pair. Pictures whose numbers are not known, and those of two sizes, stay as they are.
 * @param ignore_alpha  1: alpha is not compared, and colours are as they are stored
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_pair(struct score_picture *a, struct score_picture *b, int ignore_alpha);

/** Colour number `at` ([height][width][3]) as a code that is not clamped, where the pair has such. */
int score_code_at(const struct score_picture *picture, size_t at);

/** The number that has such a code, in linear light or, where is_display, as shown. */
float score_number_of(int code, int is_display);

/** How far pixel i of a is from pixel j of b: the largest difference of a colour or of alpha, codes, at most 255. */
int score_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j);

/** The same of alpha alone. */
int score_alpha_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j);
