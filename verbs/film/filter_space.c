/* filter_space: passes over the picture, each with twice the step of the one before. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "verbs/film/filter_guess.h"
#include "verbs/film/filter_weights.h"
#include "verbs/film/rows.h"

#define PASSES 5u
#define GLOSS_PASSES 2u    /* mirror images have edges that no guide has */
#define SIGMA_LIGHT 1.8f   /* brightness may differ by this multiple of the noise's standard deviation */

struct pass {
	const struct filter_frame *frame;
	uint32_t step;
	const float (*from)[3], *variance;
	float (*to)[3], *next_variance;
};

/* The variance around a pixel, which is less noisy than that of one pixel. */
static float smooth_variance(const struct pass *p, uint32_t x, uint32_t y)
{
	static const float weight[2] = { 0.5f, 0.25f };
	const struct filter_frame *f = p->frame;
	float sum = 0, weights = 0;

	for (int v = -1; v <= 1; v++)
		for (int u = -1; u <= 1; u++) {
			const int64_t px = (int64_t)x + u, py = (int64_t)y + v;

			if (px < 0 || py < 0 || px >= f->width || py >= f->height)
				continue;
			sum += weight[u != 0] * weight[v != 0] * p->variance[(size_t)py * f->width + (size_t)px];
			weights += weight[u != 0] * weight[v != 0];
		}
	return sum / weights;
}

static void pass_pixel(const struct pass *p, uint32_t x, uint32_t y)
{
	static const float kernel[3] = { 0.375f, 0.25f, 0.0625f };
	const struct filter_frame *f = p->frame;
	const size_t i = (size_t)y * f->width + x;
	const float slope = filter_slope(f, x, y), bright = filter_brightness(p->from[i]);
	const float scale = SIGMA_LIGHT * sqrtf(smooth_variance(p, x, y)) + 1e-4f * fabsf(bright) + 1e-7f;
	float sum[3] = { 0 }, variance = 0, weights = 0;

	for (int v = -2; v <= 2; v++)
		for (int u = -2; u <= 2; u++) {
			const int64_t px = (int64_t)x + u * (int64_t)p->step, py = (int64_t)y + v * (int64_t)p->step;
			size_t k;
			float w;

			if (px < 0 || py < 0 || px >= f->width || py >= f->height)
				continue;
			k = (size_t)py * f->width + (size_t)px;
			w = k == i ? 1 : filter_same_surface(f, i, k, slope, (float)p->step * hypotf((float)u, (float)v));
			if (!(w > 0))
				continue;
			w *= kernel[abs(u)] * kernel[abs(v)] * expf(-sqrtf(filter_distance2(p->from[i], p->from[k])) / scale);
			for (int c = 0; c < 3; c++)
				sum[c] += w * p->from[k][c];
			variance += w * w * p->variance[k];
			weights += w;
		}
	for (int c = 0; c < 3; c++)
		p->to[i][c] = sum[c] / weights;
	p->next_variance[i] = variance / (weights * weights);
}

static void pass_row(const void *user, uint32_t y)
{
	const struct pass *p = user;

	for (uint32_t x = 0; x < p->frame->width; x++) {
		const size_t i = (size_t)y * p->frame->width + x;

		if (p->frame->is_there[i]) {
			pass_pixel(p, x, y);
			continue;
		}
		memcpy(p->to[i], p->from[i], sizeof(p->to[i]));
		p->next_variance[i] = p->variance[i];
	}
}

/* Some passes over light or gloss; replaces *plane and *variance. */
static int run_passes(const struct filter_frame *f, uint32_t n, float (**plane)[3], float **variance)
{
	const size_t pixels = (size_t)f->width * f->height + 1;
	float (*to)[3] = malloc(pixels * sizeof(*to)), *next = malloc(pixels * sizeof(*next));
	int err = to && next ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (uint32_t i = 0; i < n && !err; i++) {
		float (*const swap)[3] = *plane, *const swap_variance = *variance;

		rows_each(f->height, pass_row, &(struct pass){ f, 1u << i, (const float (*)[3])*plane, *variance, to, next });
		*plane = to;
		*variance = next;
		to = swap;
		next = swap_variance;
	}
	free(to);
	free(next);
	return err;
}

/* The noise of gloss around each pixel, as filter_guess computes it for light. */
static void gloss_row(const void *user, uint32_t y)
{
	const struct pass *p = user;

	for (uint32_t x = 0; x < p->frame->width; x++)
		p->next_variance[(size_t)y * p->frame->width + x] = filter_noise(p->frame, p->from, x, y) /
		                                                    (SIGMA_LIGHT * SIGMA_LIGHT);
}

int filter_space(struct filter_frame *f)
{
	int err = run_passes(f, PASSES, &f->light, &f->variance);

	if (err)
		return err;
	rows_each(f->height, gloss_row,
	          &(struct pass){ .frame = f, .from = (const float(*)[3])f->gloss, .next_variance = f->variance });
	return run_passes(f, GLOSS_PASSES, &f->gloss, &f->variance);
}
