/* Pictures to compare, extracted from images as display codes. */
#pragma once

#include <stdlib.h>

#include "diff/score/score.h"

/**
 * Extract a layer from an image as display codes, and its depth ("gl.depth"), "id" and "layers" if present.
 *
 * @param layer  as in score_find_layer
 * @param out    all zero; planes are borrowed from img; free with score_picture_free
 * @return 0, ERR_INPUT (not reported: no such layer) or ERR_SYSTEM (reported)
 */
int score_picture_from_image(const struct image *img, const char *layer, struct score_picture *out);
void score_picture_free(struct score_picture *pic);

/** One linear number as a display code; NaN gives 0, values beyond [0,1] are clamped. */
uint8_t score_code_from_linear(float linear);

/** A number, display-referred or linear, as a display code. */
uint8_t score_code(float number, int is_display);

/**
 * Find the planes of a layer: NAME.R, NAME.G and NAME.B ("beauty": R, G and B, or Y), or NAME.X, NAME.Y and NAME.Z; for
 * NAME.Y alone, or a single channel of that name, three times the same. @return 1, or 0: there is none
 */
int score_find_layer(const struct image *img, const char *layer, const float *planes[3]);

/** List the layers and single channels of an image, "beauty, view.diffuse, N, Z"; truncated to `size`. */
void score_list_layers(const struct image *img, char *out, size_t size);

/** Largest difference of three codes. */
static inline int score_code_difference(const uint8_t *a, const uint8_t *b)
{
	int worst = 0;

	for (int c = 0; c < 3; c++) {
		int d = abs(a[c] - b[c]);

		worst = d > worst ? d : worst;
	}
	return worst;
}

/** 1 if a reference excludes pixel i from comparison. */
static inline int score_ignores(const struct score_picture *ref, size_t i)
{
	return ref->ignore && ref->ignore[i];
}
