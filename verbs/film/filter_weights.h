/* Weights of pixels, for all parts of the filter. */
#pragma once

#include <math.h>

#include "verbs/film/filter.h"

#define FILTER_SIGMA_DEPTH 1.0f /* depth may differ by this multiple of the slope */

static inline float filter_brightness(const float c[3])
{
	return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

/* The mean squared difference of two colours. */
static inline float filter_distance2(const float a[3], const float b[3])
{
	const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];

	return (x * x + y * y + z * z) / 3;
}

/*
 * How likely two pixels are on one smooth surface, [0,1], by their normals and depths (after Schied et al., filter.h).
 * slope: change of depth per pixel at a; step: pixels from a to b
 */
static inline float filter_same_surface(const struct filter_frame *f, size_t a, size_t b, float slope, float step)
{
	const float *n = f->normal[a], *m = f->normal[b];
	float cosine = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];

	if (!f->is_there[b] || cosine <= 0)
		return 0;
	for (int i = 0; i < 6; i++) /* the 64th power */
		cosine *= cosine;
	return cosine * expf(-fabsf(f->depth[a] - f->depth[b]) /
	                     (FILTER_SIGMA_DEPTH * slope * step + 1e-3f * fabsf(f->depth[a]) + 1e-6f));
}

/* Change of depth per pixel: on each axis the smaller of both sides, then the larger of the two axes. */
static inline float filter_slope(const struct filter_frame *f, uint32_t x, uint32_t y)
{
	const size_t i = (size_t)y * f->width + x;
	const float z = f->depth[i], left = x ? fabsf(z - f->depth[i - 1]) : INFINITY;
	const float right = x + 1 < f->width ? fabsf(z - f->depth[i + 1]) : INFINITY,
		    above = y ? fabsf(z - f->depth[i - f->width]) : INFINITY;
	const float below = y + 1 < f->height ? fabsf(z - f->depth[i + f->width]) : INFINITY;
	const float most = fmaxf(fminf(left, right), fminf(above, below));

	return isfinite(most) ? most : 0;
}
