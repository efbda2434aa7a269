#include "look/study/light/solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "look/study/motion/box.h"

enum { MOST_SAMPLES = 12000, SEARCH_SAMPLES = 1500, SEEDS = 6, FOLLOWED = 3, ROUNDS = 4 };
#define CUT_OFF (254.5 / 255)
/* Another light must explain at least this share of the light left by the others. */
#define EXPLAINS_LEAST 0.02
/* Its contribution must be spread over at least this many texels; less would only fit the errors of a few. Lights of
 * generated levels reach 98 to 270, spurious ones 1 to 9. */
#define SPREAD_LEAST 24
/* A step must explain more than this additional share, or positions would creep. */
#define CREEP 1e-7
/* A light has settled when it moves by at most this share of the world's size. */
#define SETTLED 1e-5
/* At most this share of the samples is left out. */
#define MOST_STRAYS 0.1

struct sample {
	double at[3], normal[3], light[3];
	double rest[3]; /* light not yet explained */
	double gain[SOLVE_MOST_LIGHTS]; /* light of each at unit strength */
	unsigned wall;
	uint32_t blocker; /* the last triangle that blocked a light */
	int strays;       /* 1: no lights explain it, and it is ignored */
};

struct solving {
	struct sample *samples;
	size_t n, step; /* step: a search uses every step-th sample */
	const struct occluders *walls;
	unsigned n_walls; /* in the samples */
	double (*sums)[7]; /* [n_walls], used by find_seeds: weight, place, normal */
	struct solved *out;
};

/* 1 if a sample gives the amount of light; it does not where the lightmap is cut off at 1. */
static int counts(const struct sample *x, int channel)
{
	return x->light[channel] < CUT_OFF && !x->strays;
}

/* The light of unit strength from a place, unless something is in between. */
static double gain_of(const struct solving *s, struct sample *x, const double at[3], int looks)
{
	double square = 0, along = 0, from[3];

	for (int k = 0; k < 3; k++) {
		square += (at[k] - x->at[k]) * (at[k] - x->at[k]);
		along += (at[k] - x->at[k]) * x->normal[k];
	}
	if (along <= 0 || square <= 0)
		return 0;
	for (int k = 0; k < 3; k++) /* off the wall */
		from[k] = x->at[k] + 1e-3 * sqrt(square) * x->normal[k];
	return looks && !occluders_sees(s->walls, from, at, &x->blocker) ? 0 : along / (square * sqrt(square));
}

/* The amount of unexplained light, as a drop of the sum of squares, that a light of the best strength at a place
 * explains. @param seen  for every sample, or NULL */
static double explained(const struct solving *s, const double at[3], const unsigned char *seen, unsigned char *sees)
{
	double product[3] = { 0, 0, 0 }, square[3] = { 0, 0, 0 }, sum = 0;

	for (size_t i = 0; i < s->n; i += s->step) {
		struct sample *x = &s->samples[i];
		double gain = seen && !seen[i] ? 0 : gain_of(s, x, at, !seen);

		if (sees)
			sees[i] = gain > 0;
		for (int c = 0; c < 3; c++) {
			if (!counts(x, c))
				continue;
			product[c] += gain * x->rest[c];
			square[c] += gain * gain;
		}
	}
	for (int c = 0; c < 3; c++)
		sum += product[c] > 0 && square[c] > 0 ? product[c] * product[c] / square[c] : 0;
	return sum;
}

/* Move to a better place in shrinking steps; the samples in sight are assumed to stay the same. @return the amount
 * explained there */
static double walk(const struct solving *s, double at[3], double step, const unsigned char *sees)
{
	double best = explained(s, at, sees, NULL);

	for (double reach = step; reach > 1e-4 * step;) {
		int better = 0;

		for (int k = 0; k < 6; k++) {
			double to[3] = { at[0], at[1], at[2] }, value;

			to[k / 2] += k % 2 ? reach : -reach;
			value = explained(s, to, sees, NULL);
			if (value <= best * (1 + CREEP))
				continue;
			best = value;
			memcpy(at, to, sizeof(to));
			better = 1;
		}
		reach *= better ? 1 : 0.5;
	}
	return best;
}

/* Walk, update which samples are in sight, and walk again. */
static double search(const struct solving *s, double at[3], double step, unsigned char *sees)
{
	for (int round = 0; round < ROUNDS; round++, step *= 0.5) {
		explained(s, at, NULL, sees);
		walk(s, at, step, sees);
	}
	return explained(s, at, NULL, sees);
}

/* --- Strengths --------------------------------------------------------------------------------------------------- */

/* Fit all lights and the ambient light together, none of them negative: coordinate descent on the normal equations. */
static void fit_strengths(struct solving *s)
{
	struct solved *out = s->out;

	for (int c = 0; c < 3; c++) {
		double a[SOLVE_MOST_LIGHTS + 1][SOLVE_MOST_LIGHTS + 1] = { { 0 } }, b[SOLVE_MOST_LIGHTS + 1] = { 0 },
								    x[SOLVE_MOST_LIGHTS + 1] = { 0 };
		unsigned n = out->n + 1;

		for (size_t i = 0; i < s->n; i++) {
			const struct sample *p = &s->samples[i];

			for (unsigned j = 0; j < n && counts(p, c); j++) {
				double gj = j < out->n ? p->gain[j] : 1;

				b[j] += gj * p->light[c];
				for (unsigned k = 0; k < n && gj > 0; k++)
					a[j][k] += gj * (k < out->n ? p->gain[k] : 1);
			}
		}
		for (int sweep = 0; sweep < 400; sweep++)
			for (unsigned j = 0; j < n; j++) {
				double rest = b[j];

				for (unsigned k = 0; k < n; k++)
					rest -= k == j ? 0 : a[j][k] * x[k];
				x[j] = a[j][j] > 0 && rest > 0 ? rest / a[j][j] : 0;
			}
		for (unsigned j = 0; j < out->n; j++)
			out->lights[j].color[c] = x[j];
		out->ambient[c] = x[out->n];
	}
}

/* Compute the unexplained part of each sample without light `without`; unknown where the lightmap is cut off. */
static void leave_rest(struct solving *s, unsigned without)
{
	for (size_t i = 0; i < s->n; i++)
		for (int c = 0; c < 3; c++) {
			struct sample *x = &s->samples[i];

			x->rest[c] = x->light[c] - s->out->ambient[c];
			for (unsigned j = 0; j < s->out->n; j++)
				x->rest[c] -= j == without ? 0 : s->out->lights[j].color[c] * x->gain[j];
			if (x->light[c] >= CUT_OFF && x->rest[c] < 0)
				x->rest[c] = 0;
		}
}

static void light_samples(struct solving *s, unsigned which)
{
	for (size_t i = 0; i < s->n; i++)
		s->samples[i].gain[which] = gain_of(s, &s->samples[i], s->out->lights[which].at, 1);
}

static double squares_left(const struct solving *s)
{
	double sum = 0;

	for (size_t i = 0; i < s->n; i++)
		for (int c = 0; c < 3; c++)
			sum += counts(&s->samples[i], c) ? s->samples[i].rest[c] * s->samples[i].rest[c] : 0;
	return sum;
}

/* The effective number of samples that a light contributes to: n if it is equal on n and zero elsewhere. */
static double spread_of(const struct solving *s, unsigned which)
{
	double sum = 0, squares = 0;

	for (size_t i = 0; i < s->n; i++) {
		const struct sample *x = &s->samples[i];
		double gain = counts(x, 0) && counts(x, 1) && counts(x, 2) ? x->gain[which] * x->gain[which] : 0;

		sum += gain;
		squares += gain * gain;
	}
	return squares > 0 ? sum * sum / squares : 0;
}

/* --- Places ------------------------------------------------------------------------------------------------------ */

/* Walls with the most unexplained light, which have a light in front. Fills starting places for searches. @return how
 * many */
static unsigned find_seeds(const struct solving *s, double scale, double seeds[][3], unsigned most)
{
	double (*const sum)[7] = s->sums;
	unsigned n = 0;

	memset(sum, 0, s->n_walls * sizeof(*sum));
	for (size_t i = 0; i < s->n; i++) {
		const struct sample *x = &s->samples[i];
		double weight = fmax(0, x->rest[0]) + fmax(0, x->rest[1]) + fmax(0, x->rest[2]);

		weight *= weight;
		sum[x->wall][0] += weight;
		for (int k = 0; k < 3; k++) {
			sum[x->wall][1 + k] += weight * x->at[k];
			sum[x->wall][4 + k] += weight * x->normal[k];
		}
	}
	for (unsigned wall = 0; wall < SEEDS && s->n_walls; wall++) {
		unsigned best = 0;

		for (unsigned i = 0; i < s->n_walls; i++)
			best = sum[i][0] > sum[best][0] ? i : best;
		if (!(sum[best][0] > 0))
			break;
		for (double height = 0.005 * scale; height < 0.2 * scale && n < most; height *= 1.7, n++)
			for (int k = 0; k < 3; k++)
				seeds[n][k] = sum[best][1 + k] / sum[best][0] + height * sum[best][4 + k] / sum[best][0];
		sum[best][0] = 0;
	}
	return n;
}

/* The place that a search ended at, and what a light there explains. */
struct found {
	double at[3], value;
};

static int compare_found(const void *a, const void *b)
{
	double x = ((const struct found *)a)->value, y = ((const struct found *)b)->value;

	return x > y ? -1 : x < y;
}

/* Follow the most promising seeds. @return how many; the best is first */
static unsigned follow_seeds(const struct solving *s, double scale, unsigned char *sees, struct found found[FOLLOWED])
{
	double seeds[SEEDS * 8][3], value[SEEDS * 8];
	unsigned n = find_seeds(s, scale, seeds, SEEDS * 8), rank = 0;

	for (unsigned i = 0; i < n; i++)
		value[i] = explained(s, seeds[i], NULL, NULL);
	for (; rank < FOLLOWED && rank < n; rank++) {
		unsigned first = 0;

		for (unsigned i = 0; i < n; i++)
			first = value[i] > value[first] ? i : first;
		memcpy(found[rank].at, seeds[first], sizeof(found[rank].at));
		value[first] = -1;
		found[rank].value = search(s, found[rank].at, 0.05 * scale, sees);
	}
	qsort(found, rank, sizeof(*found), compare_found);
	return rank;
}

/*
 * Add the light that explains the most. Searches use few samples, but the decision uses all of them. A light that
 * explains only a few texels is rejected.
 * @return 1; 0: none explains enough
 */
static int add_light(struct solving *s, double scale, unsigned char *sees)
{
	struct found found[FOLLOWED];
	const double before = squares_left(s), least = EXPLAINS_LEAST * before;
	unsigned n = follow_seeds(s, scale, sees, found);

	for (unsigned i = 0; i < n && s->out->n < SOLVE_MOST_LIGHTS; i++) {
		if (!(found[i].value * (double)s->step > least))
			break;
		memcpy(s->out->lights[s->out->n].at, found[i].at, sizeof(found[i].at));
		light_samples(s, s->out->n++);
		fit_strengths(s);
		leave_rest(s, SOLVE_MOST_LIGHTS);
		if (before - squares_left(s) > least && spread_of(s, s->out->n - 1) > SPREAD_LEAST)
			return 1;
		s->out->n--;
		fit_strengths(s);
		leave_rest(s, SOLVE_MOST_LIGHTS);
	}
	return 0;
}

/* Move each light to where it best explains what the others leave, until all have settled. */
static void polish(struct solving *s, double scale, unsigned char *sees)
{
	int moves = 1;

	for (int round = 0; round < ROUNDS && moves; round++) {
		moves = 0;
		for (unsigned j = 0; j < s->out->n; j++) {
			double *at = s->out->lights[j].at, old[3] = { at[0], at[1], at[2] };

			leave_rest(s, j);
			for (size_t i = 0; i < s->n; i++)
				sees[i] = s->samples[i].gain[j] > 0;
			walk(s, at, 0.01 * scale, sees);
			moves |= fabs(at[0] - old[0]) + fabs(at[1] - old[1]) + fabs(at[2] - old[2]) > SETTLED * scale;
			light_samples(s, j);
			fit_strengths(s);
		}
	}
}

/* Remove lights that explain next to nothing, or only a few texels. */
static void prune(struct solving *s)
{
	double all = 0;

	leave_rest(s, SOLVE_MOST_LIGHTS);
	all = squares_left(s);
	for (unsigned j = s->out->n; j-- > 0;) {
		struct solved_light *l = &s->out->lights[j];
		double without;

		leave_rest(s, j);
		without = squares_left(s);
		l->share = without > 0 ? 1 - all / without : 0;
		if (l->color[0] + l->color[1] + l->color[2] > 0 && l->share > 0.05 && spread_of(s, j) > SPREAD_LEAST)
			continue;
		s->out->n--;
		memmove(l, l + 1, (s->out->n - j) * sizeof(*l));
		for (size_t i = 0; i < s->n; i++)
			memmove(&s->samples[i].gain[j], &s->samples[i].gain[j + 1], (s->out->n - j) * sizeof(double));
		fit_strengths(s);
		leave_rest(s, SOLVE_MOST_LIGHTS);
		all = squares_left(s);
	}
	leave_rest(s, SOLVE_MOST_LIGHTS);
}

/* The error at a sample, in its worst channel. */
static double off_by(const struct sample *x)
{
	double most = 0;

	for (int c = 0; c < 3; c++)
		most = fmax(most, x->light[c] < CUT_OFF ? fabs(x->rest[c]) : 0);
	return most;
}

/*
 * Some samples are wrong: a vertex at the rim of a shadow may be on its other side. Leave out the ones that the
 * lights explain worst, with a stricter limit each time, and move the lights to fit the rest. If too many would be
 * left out, the lights are wrong instead.
 */
static void leave_out_strays(struct solving *s, double scale, unsigned char *sees)
{
	static const double most_steps[] = { 32, 6, 2 }; /* in steps of 8 bits */

	for (size_t round = 0; round < sizeof(most_steps) / sizeof(most_steps[0]); round++) {
		size_t n = 0;

		for (size_t i = 0; i < s->n; i++)
			n += off_by(&s->samples[i]) > most_steps[round] / 255;
		if (!s->out->n || n > MOST_STRAYS * (double)s->n)
			break;
		for (size_t i = 0; i < s->n; i++)
			s->samples[i].strays = off_by(&s->samples[i]) > most_steps[round] / 255;
		fit_strengths(s);
		polish(s, scale, sees);
		leave_rest(s, SOLVE_MOST_LIGHTS);
	}
}

/* The error that the lights leave, samples left out included. */
static double residual_of(struct solving *s)
{
	for (size_t i = 0; i < s->n; i++)
		s->samples[i].strays = 0;
	return sqrt(squares_left(s) / (3.0 * (double)s->n + 1));
}

static double extent_of(const struct lightmaps *maps)
{
	struct box box = box_empty;
	double most = 0;

	for (size_t i = 0; i < maps->n; i++)
		box_widen(&box, maps->texels[i].at);
	for (int k = 0; k < 3; k++)
		most = fmax(most, box.high[k] - box.low[k]);
	return most;
}

int solve_lights(struct lightmaps *maps, struct solved *out)
{
	struct solving s = { .walls = &maps->walls, .out = out };
	size_t every = maps->n / MOST_SAMPLES + 1;
	unsigned char *sees = calloc(maps->n + 1, 1);
	double scale = extent_of(maps), dark[3] = { 1, 1, 1 };
	int err = occluders_build(&maps->walls);

	*out = (struct solved){ .n = 0 };
	for (size_t i = 0; i < maps->n; i += every)
		s.n_walls = maps->texels[i].wall >= s.n_walls ? maps->texels[i].wall + 1 : s.n_walls;
	s.samples = calloc(maps->n / every + 1, sizeof(*s.samples));
	s.sums = malloc((s.n_walls + (size_t)1) * sizeof(*s.sums));
	if (!s.samples || !s.sums || !sees || err) {
		free(s.samples);
		free(s.sums);
		free(sees);
		return err ? err : err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	for (size_t i = 0; i < maps->n; i += every, s.n++) {
		struct sample *x = &s.samples[s.n];

		memcpy(x->at, maps->texels[i].at, sizeof(x->at));
		memcpy(x->normal, maps->texels[i].normal, sizeof(x->normal));
		memcpy(x->light, maps->texels[i].light, sizeof(x->light));
		x->wall = maps->texels[i].wall;
		for (int c = 0; c < 3; c++)
			dark[c] = fmin(dark[c], x->light[c]);
	}
	s.step = s.n / SEARCH_SAMPLES + 1;
	memcpy(out->ambient, dark, sizeof(dark));
	leave_rest(&s, SOLVE_MOST_LIGHTS);
	out->signal = sqrt(squares_left(&s) / (3.0 * (double)s.n + 1));
	while (s.n && out->n < SOLVE_MOST_LIGHTS && sqrt(squares_left(&s) / (3.0 * (double)s.n)) > 1.0 / 255 &&
	       add_light(&s, scale, sees)) {
		polish(&s, scale, sees);
		leave_rest(&s, SOLVE_MOST_LIGHTS);
	}
	prune(&s);
	s.step = 1;
	leave_out_strays(&s, scale, sees);
	prune(&s);
	out->residual = residual_of(&s);
	out->texels = s.n;
	free(s.samples);
	free(s.sums);
	free(sees);
	return 0;
}
