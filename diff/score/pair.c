/* Computes the codes of a pair of pictures. */
#include "diff/score/pair.h"

#include <math.h>
#include <string.h>

#include "base/err.h"

/* Codes for a factor of e in light: the slope of 255 sRGB(x) at white. */
#define CODES_OVER_WHITE (255 * 1.055f / 2.4f)
#define NOT_A_NUMBER INT16_MAX /* the code of NaN: far from all others */

/* A linear number as an unclamped code. */
static int wide_code(float linear)
{
	const float x = fabsf(linear);
	const float code = x <= 1 ? 255 * image_display_from_linear(x) : 255 + CODES_OVER_WHITE * logf(fminf(x, 3e38f));

	return isnan(x) ? NOT_A_NUMBER : (int)lrintf(copysignf(code, linear));
}

float score_number_of(int code, int is_display)
{
	const float shown = (float)code / 255;

	return is_display  ? shown :
	       code <= 255 ? image_linear_from_display(shown) :
	                     expf((float)(code - 255) / CODES_OVER_WHITE);
}

static int is_alpha_compared(const struct score_numbers *a, const struct score_numbers *b)
{
	if (a->is_frame != b->is_frame)
		return 0; /* a framebuffer's alpha is invisible, and a screenshot may lack it */
	return a->is_frame ? a->alpha && b->alpha : a->alpha || b->alpha;
}

/* 1 if a number is below 0 or above 1, or NaN. */
static int has_beyond(const struct score_numbers *n, size_t pixels)
{
	for (int c = 0; c < 3; c++)
		for (size_t i = 0; i < pixels; i++)
			if (!(n->rgb[c][i] >= 0 && n->rgb[c][i] <= 1))
				return 1;
	return 0;
}

/* The factor that multiplies pixel i's colours by its alpha, unless they are stored that way. */
static float weight_of(const struct score_numbers *n, int with_alpha, size_t i)
{
	return with_alpha && n->alpha && n->is_straight ? n->alpha[i] : 1;
}

/* Fill the codes, alpha and beyond. */
static void fill(struct score_picture *p, int with_alpha, size_t pixels)
{
	const struct score_numbers *n = &p->numbers;

	for (size_t i = 0; i < pixels; i++) {
		const float weight = weight_of(n, with_alpha, i);

		if (with_alpha)
			p->alpha[i] = n->alpha ? score_code(n->alpha[i], 1) : 255;
		for (int c = 0; c < 3; c++) {
			const size_t at = 3 * i + (size_t)c;
			const float number = n->rgb[c][i] * weight;

			p->rgb[at] = score_code(number, n->is_display);
			if (p->beyond)
				p->beyond[at] = (int16_t)(wide_code(number) - p->rgb[at]);
		}
	}
}

static int make_codes(struct score_picture *p, int with_alpha, int with_range)
{
	const size_t n = (size_t)p->width * p->height;
	const int is_wide = with_range && has_beyond(&p->numbers, n);

	free(p->alpha);
	free(p->beyond);
	p->alpha = with_alpha ? malloc(n ? n : 1) : NULL;
	p->beyond = is_wide ? malloc((n ? n : 1) * 3 * sizeof(*p->beyond)) : NULL;
	if ((with_alpha && !p->alpha) || (is_wide && !p->beyond))
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", p->width, p->height);
	if (with_alpha || is_wide)
		fill(p, with_alpha, n);
	return 0;
}

int score_pair(struct score_picture *a, struct score_picture *b, int ignore_alpha)
{
	const int with_alpha = !ignore_alpha && is_alpha_compared(&a->numbers, &b->numbers);
	const int with_range = !a->numbers.is_display && !b->numbers.is_display;
	int err;

	if (!a->numbers.rgb[0] || !b->numbers.rgb[0] || a->width != b->width || a->height != b->height)
		return 0;
	err = make_codes(a, with_alpha, with_range);
	return err ? err : make_codes(b, with_alpha, with_range);
}

int score_code_at(const struct score_picture *p, size_t at)
{
	return p->rgb[at] + (p->beyond ? p->beyond[at] : 0);
}

int score_alpha_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j)
{
	return a->alpha && b->alpha ? abs(a->alpha[i] - b->alpha[j]) : 0;
}

int score_difference(const struct score_picture *a, size_t i, const struct score_picture *b, size_t j)
{
	int worst = score_alpha_difference(a, i, b, j);

	for (size_t c = 0; c < 3; c++) {
		const int d = abs(score_code_at(a, 3 * i + c) - score_code_at(b, 3 * j + c));

		worst = d > worst ? d : worst;
	}
	return worst < 255 ? worst : 255;
}
