#include "film/filter.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

#define ALBEDO_LEAST 0.02f /* light is what a surface shows over its albedo, at least this */
#define PASSES 5u
#define INNER_LEAST 0.1f   /* of same_surface, for pixels that lie within a surface */
#define GLOSS_PASSES 2u    /* what mirrors show has edges that no guide knows */
#define SIGMA_LIGHT 1.8f   /* as many standard deviations of the noise */
#define SIGMA_DEPTH 1.0f
#define MOST_THREADS 16u

static float brightness(const float c[3])
{
	return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

/* The mean square of what two colours differ by. */
static float distance2(const float a[3], const float b[3])
{
	const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];

	return (x * x + y * y + z * z) / 3;
}

/* --- Rows on threads ------------------------------------------------------------------------------------------------------- */

struct rows {
	void (*run)(const void *user, uint32_t y);
	const void *user;
	uint32_t first, step, end;
};

static void *run_rows(void *arg)
{
	const struct rows *r = arg;

	for (uint32_t y = r->first; y < r->end; y += r->step)
		r->run(r->user, y);
	return NULL;
}

/* Each row on its own: no result depends on who does it. */
static void each_row(uint32_t height, void (*run)(const void *user, uint32_t y), const void *user)
{
	const long cores = sysconf(_SC_NPROCESSORS_ONLN);
	const uint32_t n = cores < 1 ? 1 : cores > (long)MOST_THREADS ? MOST_THREADS : (uint32_t)cores;
	pthread_t threads[MOST_THREADS];
	struct rows rows[MOST_THREADS];
	int started[MOST_THREADS] = { 0 };

	for (uint32_t i = 0; i < n; i++)
		rows[i] = (struct rows){ run, user, i, n, height };
	for (uint32_t i = 1; i < n; i++)
		started[i] = pthread_create(&threads[i], NULL, run_rows, &rows[i]) == 0;
	for (uint32_t i = 0; i < n; i++)
		if (!started[i])
			run_rows(&rows[i]);
	for (uint32_t i = 1; i < n; i++)
		if (started[i])
			pthread_join(threads[i], NULL);
}

/* --- Frames ------------------------------------------------------------------------------------------------------------------ */

static int allocate(struct filter_frame *f)
{
	const size_t n = (size_t)f->width * f->height + 1;

	f->light = calloc(n, sizeof(*f->light));
	f->gloss = calloc(n, sizeof(*f->gloss));
	f->variance = calloc(n, sizeof(*f->variance));
	f->guess = calloc(n, sizeof(*f->guess));
	f->albedo = calloc(n, sizeof(*f->albedo));
	f->normal = calloc(n, sizeof(*f->normal));
	f->depth = calloc(n, sizeof(*f->depth));
	f->motion = calloc(n, sizeof(*f->motion));
	f->is_there = calloc(n, 1);
	f->is_inner = calloc(n, 1);
	if (f->is_inner && f->light && f->gloss && f->variance && f->guess && f->albedo && f->normal && f->depth && f->motion && f->is_there)
		return 0;
	return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", f->width, f->height);
}

void filter_free(struct filter_frame *f)
{
	free(f->light);
	free(f->gloss);
	free(f->variance);
	free(f->guess);
	free(f->albedo);
	free(f->normal);
	free(f->depth);
	free(f->motion);
	free(f->is_there);
	free(f->is_inner);
	*f = (struct filter_frame){ 0 };
}

/* A frame's planes by group: three of each, but for Z. */
struct planes {
	const float *beauty[3], *reflect[3], *refract[3], *albedo[3], *normal[3], *motion[3], *depth;
};

static const struct group {
	const char *prefix, *letters;
	size_t offset;
	int is_needed;
} groups[] = {
	{ "", "RGB", offsetof(struct planes, beauty), 1 },
	{ "reflect.", "RGB", offsetof(struct planes, reflect), 1 },
	{ "refract.", "RGB", offsetof(struct planes, refract), 1 },
	{ "albedo.", "RGB", offsetof(struct planes, albedo), 1 },
	{ "N.", "XYZ", offsetof(struct planes, normal), 1 },
	{ "motion.", "XYA", offsetof(struct planes, motion), 0 },
};

static int find_planes(struct image *img, const char *where, struct planes *out)
{
	for (size_t g = 0; g < sizeof(groups) / sizeof(groups[0]); g++)
		for (int c = 0; c < 3; c++) {
			const float **plane = (const float **)(void *)((char *)out + groups[g].offset) + c;
			char name[16] = "";

			strcat(name, groups[g].prefix);
			strncat(name, groups[g].letters + c, 1);
			*plane = image_channel(img, name);
			if (!*plane && groups[g].is_needed)
				return err_report(ERR_INPUT, where, "has no channel %s; render it with all channels, or --aov %s",
				                  name, FILTER_NEEDS);
		}
	out->depth = image_channel(img, "Z");
	return out->depth ? 0 : err_report(ERR_INPUT, where, "has no channel Z; render it with all channels, or --aov %s", FILTER_NEEDS);
}

int filter_take(struct image *img, const char *where, struct filter_frame *f)
{
	struct planes p = { .depth = NULL };
	int err = find_planes(img, where, &p);

	if (err)
		return err;
	f->width = img->width;
	f->height = img->height;
	err = allocate(f);
	for (size_t i = 0; i < (size_t)f->width * f->height && !err; i++) {
		float square = 0;

		for (int c = 0; c < 3; c++) {
			f->albedo[i][c] = fmaxf(p.albedo[c][i], ALBEDO_LEAST);
			f->gloss[i][c] = p.reflect[c][i] + p.refract[c][i];
			f->light[i][c] = (p.beauty[c][i] - f->gloss[i][c]) / f->albedo[i][c];
			f->normal[i][c] = p.normal[c][i];
			f->motion[i][c] = p.motion[0] && p.motion[1] && p.motion[2] ? p.motion[c][i] : 0;
			square += f->normal[i][c] * f->normal[i][c];
		}
		f->depth[i] = p.depth[i];
		f->is_there[i] = square > 0.25f && isfinite(f->depth[i]) && isfinite(brightness(f->light[i]) + brightness(f->gloss[i]));
	}
	return err;
}

/* --- Weights ------------------------------------------------------------------------------------------------------------------- */

/* How much two pixels lie on one smooth surface. step: pixels between them */
static float same_surface(const struct filter_frame *f, size_t a, size_t b, float slope, float step)
{
	const float *n = f->normal[a], *m = f->normal[b];
	float cosine = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];

	if (!f->is_there[b] || cosine <= 0)
		return 0;
	for (int i = 0; i < 6; i++) /* to the 64th */
		cosine *= cosine;
	return cosine * expf(-fabsf(f->depth[a] - f->depth[b]) / (SIGMA_DEPTH * slope * step + 1e-3f * fabsf(f->depth[a]) + 1e-6f));
}

/* By how much depth changes from pixel to pixel: the lesser of what it does on both sides, of both axes the greater. */
static float slope_at(const struct filter_frame *f, uint32_t x, uint32_t y)
{
	const size_t i = (size_t)y * f->width + x;
	const float z = f->depth[i], left = x ? fabsf(z - f->depth[i - 1]) : INFINITY;
	const float right = x + 1 < f->width ? fabsf(z - f->depth[i + 1]) : INFINITY, above = y ? fabsf(z - f->depth[i - f->width]) : INFINITY;
	const float below = y + 1 < f->height ? fabsf(z - f->depth[i + f->width]) : INFINITY;
	const float most = fmaxf(fminf(left, right), fminf(above, below));

	return isfinite(most) ? most : 0;
}

/* --- A guess ------------------------------------------------------------------------------------------------------------------- */

#define WINDOW 3u          /* pixels to each side */
#define MOST_PAIRS 128u
#define QUANTILE 0.6f      /* which of the pairs is looked at; and the same quantile of a normal variable's square */
#define QUANTILE_SQUARE 0.7083f

static int by_size(const void *a, const void *b)
{
	const float x = *(const float *)a, y = *(const float *)b;

	return (x > y) - (x < y);
}

/* Half the squared difference of two neighbours, where they lie on one surface. */
static void add_pair(const struct filter_frame *f, const float (*plane)[3], size_t a, size_t b, float slope, float *pairs, size_t *n)
{
	if (*n < MOST_PAIRS && f->is_there[a] && same_surface(f, a, b, slope, 1) > 0.5f)
		pairs[(*n)++] = distance2(plane[a], plane[b]) / 2;
}

/*
 * The variance of the noise about a pixel, from how much neighbours differ. Most pairs of neighbours do so by noise alone; edges of
 * shadows, where some differ by more, are no noise and stay.
 */
static float noise_about(const struct filter_frame *f, const float (*plane)[3], uint32_t x, uint32_t y)
{
	const float slope = slope_at(f, x, y);
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

/* Whether all of the eight pixels about one lie on its surface. */
static int is_inner(const struct filter_frame *f, uint32_t x, uint32_t y, float slope)
{
	const size_t i = (size_t)y * f->width + x;

	for (uint32_t v = y ? y - 1 : 0; v <= y + 1 && v < f->height; v++)
		for (uint32_t u = x ? x - 1 : 0; u <= x + 1 && u < f->width; u++)
			if (!(same_surface(f, i, (size_t)v * f->width + u, slope, hypotf((float)u - (float)x, (float)v - (float)y)) > INNER_LEAST))
				return 0;
	return 1;
}

/* The noise of brightness, and its mean over 7 x 7 pixels of the same surface. */
static void guess_row(const void *user, uint32_t y)
{
	const struct filter_frame *f = user;

	for (uint32_t x = 0; x < f->width; x++) {
		const size_t i = (size_t)y * f->width + x;
		const float slope = slope_at(f, x, y);
		float sum = 0, weights = 0;

		if (!f->is_there[i])
			continue;
		for (uint32_t v = y > WINDOW ? y - WINDOW : 0; v <= y + WINDOW && v < f->height; v++)
			for (uint32_t u = x > WINDOW ? x - WINDOW : 0; u <= x + WINDOW && u < f->width; u++) {
				const size_t k = (size_t)v * f->width + u;
				const float w = same_surface(f, i, k, slope, hypotf((float)u - (float)x, (float)v - (float)y));

				sum += w > 0 ? w * brightness(f->light[k]) : 0;
				weights += w;
			}
		f->guess[i] = weights > 0 ? sum / weights : brightness(f->light[i]);
		f->variance[i] = noise_about(f, (const float (*)[3])f->light, x, y);
		f->is_inner[i] = (uint8_t)is_inner(f, x, y, slope);
	}
}

int filter_guess(struct filter_frame *f)
{
	each_row(f->height, guess_row, f);
	return 0;
}

/* --- Over time ----------------------------------------------------------------------------------------------------------------- */

/* Where each pixel of a frame is in the next one: motion vectors turned round. [pixels][2]; INFINITY: nowhere */
static void turn_round(const struct filter_frame *next, float (*out)[2])
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

/* The pixel at a place. @return 0: it lies outside */
static int pixel_at(const struct filter_frame *f, const float at[2], size_t *pixel)
{
	if (!(at[0] >= 0) || !(at[1] >= 0) || !(at[0] < (float)f->width) || !(at[1] < (float)f->height))
		return 0;
	*pixel = (size_t)at[1] * f->width + (size_t)at[0];
	return 1;
}

/* A step along one point's way: to the frame before (its own motion) or the next. @return 0: it is not known */
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

/* How much of a pixel of another frame counts: the same surface, as bright as the noise of both guesses allows. */
static float same_point(const struct filter_frame *a, size_t i, const struct filter_frame *b, size_t k)
{
	const float *n = a->normal[i], *m = b->normal[k], *c = a->albedo[i], *d = b->albedo[k];
	const float off = a->guess[i] - b->guess[k], scale = 0.02f * (a->guess[i] + b->guess[k]) +
	                                                      0.3f * sqrtf(a->variance[i] + b->variance[k]) + 1e-4f;

	/* the viewer may turn a little from frame to frame, and so do normals in eye space */
	if (!b->is_inner[k] || n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < 0.9f ||
	    fabsf(a->depth[i] - b->depth[k]) > 0.1f * (fabsf(a->depth[i]) + fabsf(b->depth[k])) ||
	    fabsf(c[0] - d[0]) + fabsf(c[1] - d[1]) + fabsf(c[2] - d[2]) > 0.15f * (c[0] + c[1] + c[2]) + 0.02f)
		return 0;
	return expf(-off * off / (scale * scale));
}

/* What is summed up of a pixel. */
struct mix {
	float light[3], gloss[3], weights, squares;
};

/* Add the four pixels about a place of another frame, as near as they are. @return 0: it lies outside */
static int mix_place(const struct filter_frame *here, size_t i, const struct filter_frame *there, const float at[2], struct mix *mix)
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
			turn_round(frames[i + 1], onwards[i]);
		else
			err = err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (!err)
		each_row(out->height, mix_row, &(struct over_time){ frames, n, middle, onwards, out });
	for (unsigned i = 0; onwards && i < n; i++)
		free(onwards[i]);
	free(onwards);
	return err;
}

/* --- Over the picture ---------------------------------------------------------------------------------------------------------- */

struct pass {
	const struct filter_frame *frame;
	uint32_t step;
	const float (*from)[3], *variance;
	float (*to)[3], *next_variance;
};

/* The variance about a pixel, itself less noisy than one pixel's. */
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
	const float slope = slope_at(f, x, y), bright = brightness(p->from[i]);
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
			w = k == i ? 1 : same_surface(f, i, k, slope, (float)p->step * hypotf((float)u, (float)v));
			if (!(w > 0))
				continue;
			w *= kernel[abs(u)] * kernel[abs(v)] * expf(-sqrtf(distance2(p->from[i], p->from[k])) / scale);
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

/* Some passes over light or gloss; *plane and *variance are exchanged for others. */
static int run_passes(const struct filter_frame *f, uint32_t n, float (**plane)[3], float **variance)
{
	const size_t pixels = (size_t)f->width * f->height + 1;
	float (*to)[3] = malloc(pixels * sizeof(*to)), *next = malloc(pixels * sizeof(*next));
	int err = to && next ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (uint32_t i = 0; i < n && !err; i++) {
		float (*const swap)[3] = *plane, *const swap_variance = *variance;

		each_row(f->height, pass_row, &(struct pass){ f, 1u << i, (const float (*)[3])*plane, *variance, to, next });
		*plane = to;
		*variance = next;
		to = swap;
		next = swap_variance;
	}
	free(to);
	free(next);
	return err;
}

/* The noise of what mirrors show, about each pixel: as guess_row has it of light. */
static void gloss_row(const void *user, uint32_t y)
{
	const struct pass *p = user;

	for (uint32_t x = 0; x < p->frame->width; x++)
		p->next_variance[(size_t)y * p->frame->width + x] = noise_about(p->frame, p->from, x, y) / (SIGMA_LIGHT * SIGMA_LIGHT);
}

int filter_space(struct filter_frame *f)
{
	int err = run_passes(f, PASSES, &f->light, &f->variance);

	if (err)
		return err;
	each_row(f->height, gloss_row, &(struct pass){ .frame = f, .from = (const float (*)[3])f->gloss, .next_variance = f->variance });
	return run_passes(f, GLOSS_PASSES, &f->gloss, &f->variance);
}

/* --- Back into the picture ------------------------------------------------------------------------------------------------------- */

static void drop_channel(struct image *img, size_t i)
{
	free(img->channels[i].values);
	free(img->channels[i].halves);
	memmove(&img->channels[i], &img->channels[i + 1], (img->n_channels - i - 1) * sizeof(*img->channels));
	img->n_channels--;
}

/* Files take a channel as it was rendered, where that is still there. */
static void forget_halves(struct image *img, const float *plane)
{
	for (size_t i = 0; i < img->n_channels; i++)
		if (img->channels[i].values == plane) {
			free(img->channels[i].halves);
			img->channels[i].halves = NULL;
		}
}

int filter_beauty(struct image *img, float *to[3])
{
	static const char *const effects[] = { "shadow.", "relight.", "reflect.", "refract." };

	for (int c = 0; c < 3; c++) {
		const char name[2] = { "RGB"[c], '\0' };

		to[c] = image_channel(img, name);
		if (!to[c])
			return ERR_SYSTEM;
		forget_halves(img, to[c]);
	}
	for (size_t i = img->n_channels; i-- > 0;)
		for (int k = 0; k < 4; k++)
			if (strncmp(img->channels[i].name, effects[k], strlen(effects[k])) == 0) {
				drop_channel(img, i);
				break;
			}
	return image_set_attribute(img, "relume:denoised", "1");
}

int filter_put(const struct filter_frame *f, struct image *img)
{
	float *to[3];
	const int err = filter_beauty(img, to);

	for (size_t i = 0; i < (size_t)f->width * f->height && !err; i++)
		for (int c = 0; c < 3; c++)
			to[c][i] = f->is_there[i] ? f->light[i][c] * f->albedo[i][c] + f->gloss[i][c] : to[c][i];
	return err;
}

int filter_alone(struct image *img)
{
	struct filter_frame f = { .width = 0 };
	int err = filter_take(img, NULL, &f);

	if (!err)
		err = filter_guess(&f);
	if (!err)
		err = filter_space(&f);
	if (!err)
		err = filter_put(&f, img);
	filter_free(&f);
	return err;
}
