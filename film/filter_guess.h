/* The noise about a pixel. */
#pragma once

#include "film/filter.h"

/**
 * The variance of the noise about a pixel, from how much neighbours differ. Most pairs of neighbours do so by noise alone; edges of
 * shadows, where some differ by more, are no noise and stay.
 * @param plane  [pixels] of the frame, whatever it shows
 */
float filter_noise(const struct filter_frame *frame, const float (*plane)[3], uint32_t x, uint32_t y);
