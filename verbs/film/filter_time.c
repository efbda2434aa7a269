/* filter_time: finds a pixel's point in frames before and after, and mixes its light. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "verbs/film/filter.h"
#include "verbs/film/rows.h"

/* The position of each pixel of a frame in the next one: motion vectors reversed. [pixels][2]; INFINITY: none */
static void reverse_motion(const struct filter_frame *next, float (*out)[2])
{
	for (size_t i = 0; i < (size_t)next->width * next->height; i++)
		out[i][0] = out[i][1] = INFINITY;
	for (uint32_t y = 0; y < next->height; y++)
		for (uint32_t x = 0; x < next->width; x++) {
			const float *m = next->motion[(size_t)y * next->width + x];
			const float px = floorf((float)x + 0.5f - m[0]), py = floorf((float)y + 0.5f - m[1]);

			if (m[2] > 0 && px >= 0 && py >= 0 && px < (float)next->width && py < (float)next->height) {
				float *to = out[(size_t)py * next->width + (size_t)px];

				to[0] = m[0];
				to[1] = m[1];
			}
		}
}

/* The pixel at a position. @return 0: it is outside */
static int pixel_at(const struct filter_frame *f, const float at[2], size_t *pixel)
{
	if (!(at[0] >= 0) || !(at[1] >= 0) || !(at[0] < (float)f->width) || !(at[1] < (float)f->height))
		return 0;
	*pixel = (size_t)at[1] * f->width + (size_t)at[0];
	return 1;
}

/* One step along a point's path: to the frame before (its own motion) or the next. @return 0: not known */
static int step(const struct filter_frame *from, const float (*onwards)[2], float at[2])
{
	size_t pixel;

	if (!pixel_at(from, at, &pixel))
		return 0;
	if (!onwards && !(from->motion[pixel][2] > 0))
		return 0;
	for (int k = 0; k < 2; k++)
		at[k] += onwards ? onwards[pixel][k] : -from->motion[pixel][k];
	return isfinite(at[0] + at[1]);
}

struct over_time {
	const struct filter_frame *const *frames;
	unsigned n, middle;
	float (*const *onwards)[2]; /* [n] from each frame to the next; NULL: not wanted */
	struct filter_frame *out;
};

/* The weight of another frame's pixel: 0 unless it is on the same surface; lower if it is brighter or darker than noise
 * explains. */
static float same_point(const struct filter_frame *a, size_t i, const struct filter_frame *b, size_t k)
{
	const float *n = a->normal[i], *m = b->normal[k], *c = a->albedo[i], *d = b->albedo[k];
	const float off = a->guess[i] - b->guess[k], scale = 0.02f * (a->guess[i] + b->guess[k]) +
	                                                      0.3f * sqrtf(a->variance[i] + b->variance[k]) + 1e-4f;

	/* the viewer may turn a little between frames, which turns normals in eye space */
	if (!b->is_inner[k] || n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < 0.9f ||
	    fabsf(a->depth[i] - b->depth[k]) > 0.1f * (fabsf(a->depth[i]) + fabsf(b->depth[k])) ||
	    fabsf(c[0] - d[0]) + fabsf(c[1] - d[1]) + fabsf(c[2] - d[2]) > 0.15f * (c[0] + c[1] + c[2]) + 0.02f)
		return 0;
	return expf(-off * off / (scale * scale));
}

/* Weighted sums for a pixel. */
struct mix {
	float light[3], gloss[3], weights, squares;
};

/* Add the four pixels around a position in another frame, weighted by distance. @return 0: it is outside */
static int mix_place(const struct filter_frame *here, size_t i, const struct filter_frame *there, const float at[2],
                     struct mix *mix)
{
	const float x = at[0] - 0.5f, y = at[1] - 0.5f, left = floorf(x), top = floorf(y);
	size_t inside;

	if (!pixel_at(there, at, &inside))
		return 0;
	for (int k = 0; k < 4; k++) {
		const float px = left + (float)(k & 1), py = top + (float)(k >> 1);
		float w = (1 - fabsf(x - px)) * (1 - fabsf(y - py));
		size_t j;

		if (!(w > 0) || !pixel_at(there, (float[2]){ px + 0.5f, py + 0.5f }, &j))
			continue;
		w *= same_point(here, i, there, j);
		for (int c = 0; c < 3 && w > 0; c++) {
			mix->light[c] += w * there->light[j][c];
			mix->gloss[c] += w * there->gloss[j][c];
		}
		mix->weights += w;
		mix->squares += w * w;
	}
	return 1;
}

static void mix_pixel(const struct over_time *t, size_t i, uint32_t x, uint32_t y)
{
	const struct filter_frame *here = t->frames[t->middle];
	struct mix mix = { .weights = 1, .squares = 1 };

	memcpy(mix.light, here->light[i], sizeof(mix.light));
	memcpy(mix.gloss, here->gloss[i], sizeof(mix.gloss));
	for (int forward = 0; forward < 2 && here->is_inner[i]; forward++) {
		float at[2] = { (float)x + 0.5f, (float)y + 0.5f };
		unsigned frame = t->middle;

		while (forward ? frame + 1 < t->n : frame > 0) {
			if (!step(t->frames[frame], forward ? (const float (*)[2])t->onwards[frame] : NULL, at))
				break;
			frame += forward ? 1u : -1u;
			if (!mix_place(here, i, t->frames[frame], at, &mix))
				break;
		}
	}
	for (int c = 0; c < 3; c++) {
		t->out->light[i][c] = mix.light[c] / mix.weights;
		t->out->gloss[i][c] = mix.gloss[c] / mix.weights;
	}
	t->out->variance[i] = here->variance[i] * mix.squares / (mix.weights * mix.weights);
}

static void mix_row(const void *user, uint32_t y)
{
	const struct over_time *t = user;

	for (uint32_t x = 0; x < t->out->width; x++)
		mix_pixel(t, (size_t)y * t->out->width + x, x, y);
}

int filter_time(const struct filter_frame *const *frames, unsigned n, unsigned middle, struct filter_frame *out)
{
	float (**onwards)[2] = calloc(n, sizeof(*onwards));
	int err = onwards ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (unsigned i = middle; i + 1 < n && !err; i++) {
		onwards[i] = malloc((size_t)out->width * out->height * sizeof(**onwards) + 1);
		if (onwards[i])
			reverse_motion(frames[i + 1], onwards[i]);
		else
			err = err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (!err)
		rows_each(out->height, mix_row, &(struct over_time){ frames, n, middle, onwards, out });
	for (unsigned i = 0; onwards && i < n; i++)
		free(onwards[i]);
	free(onwards);
	return err;
}
