/* Metrics between two pictures, [height][width][3] codes. Functions that return an int allocate memory: 0, or
 * ERR_SYSTEM (reported). */
#pragma once

#include <stddef.h>
#include <stdint.h>

/** Peak signal-to-noise ratio over all channels, dB; INFINITY if equal. */
double metric_psnr_db(const uint8_t *a, const uint8_t *b, size_t n_pixels);

/** Root of the mean squared difference over all channels, in [0,1]. */
double metric_rmse(const uint8_t *a, const uint8_t *b, size_t n_pixels);

/** Mean relative squared error over all channels, (test - ref)^2 / (ref^2 + 0.01), of linear values. */
double metric_mrse(const uint8_t *ref, const uint8_t *test, size_t n_pixels);

/**
 * Structural similarity on luma (Rec.709 weights on codes): Wang et al. 2004, 11x11 Gaussian of sigma 1.5, K .01 and
 * .03, mean over windows that lie inside the picture; NAN below 11 pixels.
 */
int metric_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *out);

/** Multi-scale SSIM (Wang et al. 2003) over five scales; NAN below 176 pixels. */
int metric_ms_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *out);

/** CIE L*a*b* (D65) of linear Rec.709. */
void metric_lab_from_linear(const double rgb[3], double lab[3]);

/** Colour difference CIEDE2000 (Sharma, Wu and Dalal 2005), all k = 1. */
double metric_ciede2000(const double lab1[3], const double lab2[3]);

/** 95th percentile of CIEDE2000 over all pixels; NAN without pixels. */
int metric_ciede2000_p95(const uint8_t *a, const uint8_t *b, size_t n_pixels, double *out);
