#include "verbs/film/filter_guess.h"

#include <stdlib.h>

#include "verbs/film/filter_weights.h"
#include "verbs/film/rows.h"

#define INNER_LEAST 0.1f   /* least filter_same_surface for pixels inside a surface */
#define WINDOW 3u          /* pixels to each side */
#define MOST_PAIRS 128u
#define QUANTILE 0.6f      /* the quantile of all pairs that is used */
#define QUANTILE_SQUARE 0.7083f /* the same quantile of a standard normal variable's square */

static int by_size(const void *a, const void *b)
{
	const float x = *(const float *)a, y = *(const float *)b;

	return (x > y) - (x < y);
}

/* Add half the squared difference of two neighbours if they are on one surface. */
static void add_pair(const struct filter_frame *f, const float (*plane)[3], size_t a, size_t b, float slope,
                     float *pairs, size_t *n)
{
	if (*n < MOST_PAIRS && f->is_there[a] && filter_same_surface(f, a, b, slope, 1) > 0.5f)
		pairs[(*n)++] = filter_distance2(plane[a], plane[b]) / 2;
}

float filter_noise(const struct filter_frame *f, const float (*plane)[3], uint32_t x, uint32_t y)
{
	const float slope = filter_slope(f, x, y);
	float pairs[MOST_PAIRS];
	size_t n = 0;

	for (uint32_t v = y > WINDOW ? y - WINDOW : 0; v <= y + WINDOW && v < f->height; v++)
		for (uint32_t u = x > WINDOW ? x - WINDOW : 0; u <= x + WINDOW && u < f->width; u++) {
			const size_t k = (size_t)v * f->width + u;

			if (u < x + WINDOW && u + 1 < f->width)
				add_pair(f, plane, k, k + 1, slope, pairs, &n);
			if (v < y + WINDOW && v + 1 < f->height)
				add_pair(f, plane, k, k + f->width, slope, pairs, &n);
		}
	qsort(pairs, n, sizeof(*pairs), by_size);
	return n ? pairs[(size_t)((float)(n - 1) * QUANTILE)] / QUANTILE_SQUARE : 0;
}

/* Are all eight pixels around one on its surface? */
static int is_inner(const struct filter_frame *f, uint32_t x, uint32_t y, float slope)
{
	const size_t i = (size_t)y * f->width + x;

	for (uint32_t v = y ? y - 1 : 0; v <= y + 1 && v < f->height; v++)
		for (uint32_t u = x ? x - 1 : 0; u <= x + 1 && u < f->width; u++)
			if (!(filter_same_surface(f, i, (size_t)v * f->width + u, slope,
			                          hypotf((float)u - (float)x, (float)v - (float)y)) > INNER_LEAST))
				return 0;
	return 1;
}

/* The noise of brightness, and its mean over 7 x 7 pixels of the same surface. */
static void guess_row(const void *user, uint32_t y)
{
	const struct filter_frame *f = user;

	for (uint32_t x = 0; x < f->width; x++) {
		const size_t i = (size_t)y * f->width + x;
		const float slope = filter_slope(f, x, y);
		float sum = 0, weights = 0;

		if (!f->is_there[i])
			continue;
		for (uint32_t v = y > WINDOW ? y - WINDOW : 0; v <= y + WINDOW && v < f->height; v++)
			for (uint32_t u = x > WINDOW ? x - WINDOW : 0; u <= x + WINDOW && u < f->width; u++) {
				const size_t k = (size_t)v * f->width + u;
				const float w = filter_same_surface(f, i, k, slope, hypotf((float)u - (float)x, (float)v - (float)y));

				sum += w > 0 ? w * filter_brightness(f->light[k]) : 0;
				weights += w;
			}
		f->guess[i] = weights > 0 ? sum / weights : filter_brightness(f->light[i]);
		f->variance[i] = filter_noise(f, (const float (*)[3])f->light, x, y);
		f->is_inner[i] = (uint8_t)is_inner(f, x, y, slope);
	}
}

int filter_guess(struct filter_frame *f)
{
	rows_each(f->height, guess_row, f);
	return 0;
}
