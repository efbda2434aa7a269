/* The noise around a pixel. */
#pragma once

#include "verbs/film/filter.h"

/**
 * The variance of the noise around a pixel, estimated from the differences between neighbours. Most pairs differ only
 * by noise; at the edges of shadows some differ by more, which is not noise and is kept.
 * @param plane  [pixels] of the frame, of any channels
 */
float filter_noise(const struct filter_frame *frame, const float (*plane)[3], uint32_t x, uint32_t y);
