/* Computes the maps of the colour gates: differences, edge band, failing pixels. */
#include "diff/score/maps.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "diff/score/pair.h"

#define BAR_PER_LAYER 0.5 /* R1b: codes that each blended layer adds to R1's bar */

/** The smallest difference of one pixel of `a` from the 3x3 pixels around the same place in `b`. */
static int nearest_difference(const struct score_picture *a, const struct score_picture *b, int x, int y)
{
	const int width = (int)a->width, height = (int)a->height;
	const size_t at = (size_t)y * a->width + (size_t)x;
	int best = 255;

	for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
		for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
			int d = score_difference(a, at, b, (size_t)v * a->width + (size_t)u);

			best = d < best ? d : best;
		}
	}
	return best;
}

int score_depth_is_16_bit(const float *depth, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		double steps = (double)depth[i] * 65535;

		if (fabs(steps - rint(steps)) > 1e-2)
			return 0;
	}
	return 1;
}

/** 1 if depth bends at the middle one of three adjacent samples: "edges" in score.h. */
static int depth_bends(double before, double at, double after, double epsilon)
{
	double rise = fmax(fabs(after - at), fabs(at - before));

	return !(fabs(before - 2 * at + after) <= epsilon + rise / 8); /* NaN bends */
}

static void mark_depth_edges(const float *depth, int width, int height, double epsilon, uint8_t *band)
{
	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			const float *z = depth + (size_t)y * (size_t)width + x;

			if ((x > 0 && x + 1 < width && depth_bends((double)z[-1], (double)z[0], (double)z[1], epsilon)) ||
			    (y > 0 && y + 1 < height &&
			     depth_bends((double)z[-width], (double)z[0], (double)z[width], epsilon)))
				band[z - depth] = 1;
		}
	}
}

static void mark_id_edges(const float *id, int width, int height, uint8_t *band)
{
	for (int y = 0; y < height; y++)
		for (int x = 0; x < width; x++)
			for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++)
				for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++)
					if (id[v * (ptrdiff_t)width + u] != id[y * (ptrdiff_t)width + x])
						band[y * (ptrdiff_t)width + x] = 1;
}

float score_layers_at(const struct score_picture *traced, size_t i)
{
	return traced->layers && traced->layers[i] > 0 ? traced->layers[i] : 0;
}

double score_allowed(const struct score_options *options, const struct score_picture *traced, size_t i)
{
	return (options->codes > 0 ? options->codes : SCORE_CODES) + BAR_PER_LAYER * (double)score_layers_at(traced, i);
}

int score_make_maps(const struct score_picture *ref, const struct score_picture *traced,
                    const struct score_options *options, struct score_maps *out)
{
	const double codes = options->codes > 0 ? options->codes : SCORE_CODES;
	const size_t n = (size_t)ref->width * ref->height;
	const int width = (int)ref->width, height = (int)ref->height;
	uint8_t *memory = calloc(n ? n : 1, 4);

	if (!memory)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %d x %d pixels", width, height);
	*out = (struct score_maps){ memory, memory + n, memory + 2 * n, memory + 3 * n };

	if (traced->id)
		mark_id_edges(traced->id, width, height, out->band);
	if (traced->depth)
		mark_depth_edges(traced->depth, width, height, SCORE_DEPTH_EPSILON, out->band);
	if (ref->depth)
		mark_depth_edges(ref->depth, width, height,
		                 score_depth_is_16_bit(ref->depth, n) ? SCORE_DEPTH_EPSILON_16 : SCORE_DEPTH_EPSILON,
		                 out->band);

	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			size_t i = (size_t)y * (size_t)width + (size_t)x;

			if (score_ignores(ref, i)) {
				out->band[i] = 0;
				continue;
			}
			int plain = score_difference(ref, i, traced, i), residual = plain;

			if (plain > codes) {
				int there = nearest_difference(traced, ref, x, y);
				int back = nearest_difference(ref, traced, x, y);

				residual = there > back ? there : back;
			}
			out->difference[i] = (uint8_t)plain;
			out->residual[i] = (uint8_t)residual;
			out->failing[i] = out->band[i] ? residual > codes : plain > score_allowed(options, traced, i);
		}
	}
	return 0;
}

void score_maps_free(struct score_maps *maps)
{
	free(maps->difference); /* start of the block that holds all of them */
	*maps = (struct score_maps){ 0 };
}
