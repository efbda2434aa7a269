/* Composite of several runs: the value nearest to the reference within their range. */
#include "diff/runs/composite.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/pair.h"

enum { NEIGHBOURHOOD = 16, MIN_SHARE = 4, NUMBERS = 4 };

/* Range of each number over the runs: codes of colours and alpha (pair.h), or window depth. */
struct range {
	int16_t *low, *high;       /* [n][NUMBERS] */
	uint8_t *off, *spread;     /* [n]: distance from the reference and spread of the runs, in codes, for the worst
	                              channel */
	float *near, *far;         /* [n]; NULL: the reference has no depth */
};

/* Number c of pixel i: a colour or alpha. */
static int16_t code_of(const struct score_picture *p, size_t i, size_t c)
{
	return (int16_t)(c < 3 ? score_code_at(p, 3 * i + c) : p->alpha ? p->alpha[i] : 255);
}

static uint8_t at_most_255(int difference)
{
	return (uint8_t)(difference < 255 ? difference : 255);
}

static void widen(struct range *r, const struct score_picture *p, size_t n, int is_first)
{
	for (size_t i = 0; i < n * NUMBERS; i++) {
		const int16_t code = code_of(p, i / NUMBERS, i % NUMBERS);

		r->low[i] = is_first || code < r->low[i] ? code : r->low[i];
		r->high[i] = is_first || code > r->high[i] ? code : r->high[i];
	}
	for (size_t i = 0; r->near && i < n; i++) {
		r->near[i] = is_first || p->depth[i] < r->near[i] ? p->depth[i] : r->near[i];
		r->far[i] = is_first || p->depth[i] > r->far[i] ? p->depth[i] : r->far[i];
	}
}

static void find_varying(const struct range *r, const struct score_picture *ref, int codes,
                         struct composite_varying *out)
{
	*out = (struct composite_varying){ .x0 = UINT32_MAX, .y0 = UINT32_MAX };
	for (uint32_t y = 0; y < ref->height; y++)
		for (uint32_t x = 0; x < ref->width; x++) {
			const size_t i = (size_t)y * ref->width + x;

			if (score_ignores(ref, i) || r->spread[i] <= codes)
				continue;
			out->pixels++;
			out->x0 = x < out->x0 ? x : out->x0;
			out->y0 = y < out->y0 ? y : out->y0;
			out->x1 = x > out->x1 ? x : out->x1;
			out->y1 = y > out->y1 ? y : out->y1;
		}
}

/* The number nearest to `wanted` between two bounds. */
static double nearest(double wanted, double low, double high)
{
	return wanted < low ? low : wanted > high ? high : wanted;
}

/* If runs disagree about a pixel, extend its range by its neighbours' values: edges shift by a pixel. */
static int loosen(struct range *r, const struct score_picture *ref, int codes)
{
	const size_t n = NUMBERS * (size_t)ref->width * ref->height;
	int16_t *low = malloc((n + 1) * sizeof(*low)), *high = malloc((n + 1) * sizeof(*high));

	if (!low || !high) {
		free(low);
		free(high);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	memcpy(low, r->low, n * sizeof(*low));
	memcpy(high, r->high, n * sizeof(*high));
	for (uint32_t y = 0; y < ref->height; y++)
		for (uint32_t x = 0; x < ref->width; x++) {
			const size_t at = (size_t)y * ref->width + x;

			for (uint32_t v = y ? y - 1 : 0; r->spread[at] > codes && v < ref->height && v <= y + 1; v++)
				for (uint32_t u = x ? x - 1 : 0; u < ref->width && u <= x + 1; u++)
					for (size_t c = 0; c < NUMBERS; c++) {
						const size_t i = NUMBERS * ((size_t)v * ref->width + u) + c;

						low[NUMBERS * at + c] = r->low[i] < low[NUMBERS * at + c] ? r->low[i] : low[NUMBERS * at + c];
						high[NUMBERS * at + c] = r->high[i] > high[NUMBERS * at + c] ? r->high[i] : high[NUMBERS * at + c];
					}
		}
	free(r->low);
	free(r->high);
	r->low = low;
	r->high = high;
	return 0;
}

static uint8_t spread_of(const struct range *r, size_t i)
{
	int spread = 0;

	for (size_t c = NUMBERS * i; c < NUMBERS * (i + 1); c++)
		spread = r->high[c] - r->low[c] > spread ? r->high[c] - r->low[c] : spread;
	return at_most_255(spread);
}

static void measure(const struct range *r, const struct score_picture *ref, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		r->off[i] = 0;
		for (size_t c = 0; c < NUMBERS; c++) {
			const int wanted = code_of(ref, i, c);
			const int found = (int)nearest(wanted, r->low[NUMBERS * i + c], r->high[NUMBERS * i + c]);
			const uint8_t off = at_most_255(abs(wanted - found));

			r->off[i] = off > r->off[i] ? off : r->off[i];
		}
	}
}

/* 1 if it is likely to be noise that a pixel is off in all runs. */
static int is_noise(const struct range *r, const struct score_picture *ref, uint32_t x, uint32_t y)
{
	const size_t at = (size_t)y * ref->width + x;
	const uint32_t x0 = x > NEIGHBOURHOOD ? x - NEIGHBOURHOOD : 0, y0 = y > NEIGHBOURHOOD ? y - NEIGHBOURHOOD : 0;
	uint32_t alike = 0, varying = 0;

	if (r->spread[at] >= r->off[at])
		return 1;
	for (uint32_t v = y0; v < ref->height && v <= y + NEIGHBOURHOOD; v++)
		for (uint32_t u = x0; u < ref->width && u <= x + NEIGHBOURHOOD; u++) {
			const size_t i = (size_t)v * ref->width + u;

			alike += r->off[i] > r->spread[i];
			varying += r->spread[i] >= r->off[at];
		}
	return MIN_SHARE * alike <= varying;
}

/* Replace those numbers of pixel i that have other codes. Colours stay as stored: multiplied by alpha or not. */
static void put_pixel(const struct score_picture *was, size_t i, const int16_t code[NUMBERS])
{
	const struct score_numbers *to = &was->numbers;
	const int is_other = was->alpha && code[3] != was->alpha[i];
	const float alpha = was->alpha ? (float)code[3] / 255 : 1, weight = was->alpha && to->is_straight ? alpha : 1;

	if (is_other && to->alpha)
		((float *)to->alpha)[i] = alpha;
	for (size_t c = 0; c < 3; c++)
		if (code[c] != code_of(was, i, c) || (is_other && weight != 1))
			((float *)to->rgb[c])[i] = weight > 0 ? score_number_of(code[c], to->is_display) / weight : 0;
}

static int put(struct image *base, const char *layer, struct score_picture *ref, const struct range *r,
               int ignore_alpha)
{
	const size_t n = (size_t)ref->width * ref->height;
	struct score_picture was = { 0 };
	float *depth = r->near ? image_channel(base, "gl.depth") : NULL;
	int err = score_picture_from_image(base, layer, &was);

	if (!err)
		err = score_pair(ref, &was, ignore_alpha);
	if (err) {
		score_picture_free(&was);
		return err == ERR_SYSTEM ? err : 0;
	}
	for (size_t i = 0; i < n; i++) {
		const int noise = is_noise(r, ref, (uint32_t)(i % ref->width), (uint32_t)(i / ref->width));
		int16_t code[NUMBERS];

		for (size_t c = 0; c < NUMBERS; c++) {
			const int16_t wanted = code_of(ref, i, c);

			code[c] = noise ? wanted : (int16_t)nearest(wanted, r->low[NUMBERS * i + c], r->high[NUMBERS * i + c]);
		}
		put_pixel(&was, i, code);
		if (depth)
			depth[i] = noise && r->off[i] ? ref->depth[i] : (float)nearest(ref->depth[i], r->near[i], r->far[i]);
	}
	score_picture_free(&was);
	return 0;
}

int composite_make(struct image *base, const char *layer, struct score_picture *ref, const struct image *images,
                   size_t n, int codes, int ignore_alpha, struct composite_varying *varying)
{
	const size_t pixels = (size_t)ref->width * ref->height, numbers = (NUMBERS * pixels + 1) * sizeof(int16_t);
	struct range r = { malloc(numbers), malloc(numbers), malloc(pixels + 1), malloc(pixels + 1), NULL, NULL };
	size_t used = 0;
	int err = 0;

	if (ref->depth && image_channel(base, "gl.depth")) {
		r.near = malloc((pixels + 1) * sizeof(*r.near));
		r.far = malloc((pixels + 1) * sizeof(*r.far));
	}
	if (!r.low || !r.high || !r.off || !r.spread || (!r.near) != (!r.far))
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n && !err; i++) {
		struct score_picture p = { 0 };

		if (images[i].width != ref->width || images[i].height != ref->height)
			continue;
		err = score_picture_from_image(&images[i], layer, &p);
		if (!err)
			err = score_pair(ref, &p, ignore_alpha);
		if (!err && !p.depth) {
			free(r.near);
			free(r.far);
			r.near = r.far = NULL;
		}
		if (!err)
			widen(&r, &p, pixels, used++ == 0);
		score_picture_free(&p);
		err = err == ERR_INPUT ? 0 : err; /* it lacks the layer, which validity reports */
	}
	*varying = (struct composite_varying){ .pixels = 0 };
	if (!err && used) {
		for (size_t i = 0; i < pixels; i++)
			r.spread[i] = spread_of(&r, i);
		find_varying(&r, ref, codes, varying);
		err = loosen(&r, ref, codes);
	}
	if (!err && used) {
		measure(&r, ref, pixels);
		err = put(base, layer, ref, &r, ignore_alpha);
	}
	free(r.low);
	free(r.high);
	free(r.off);
	free(r.spread);
	free(r.near);
	free(r.far);
	return err;
}
