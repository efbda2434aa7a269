/* Gates E1 to E3: does what the beauty adds to OpenGL's picture add up, has it a reason, is there enough of it. */
#include "diff/score/gates.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define BAR_CLOSURE_HALF 0x1p-9 /* E1 */
#define BAR_CLOSURE_FLOAT 1e-5

static const struct image_channel *find_channel(const struct image *img, const char *layer, int c)
{
	char name[80];

	snprintf(name, sizeof(name), layer[0] ? "%s.%c" : "%s%c", layer, "RGB"[c]);
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return &img->channels[i];
	return NULL;
}

/** 1 where all numbers of a channel are halves, however the file stores them: other tools widen what they rewrite. */
static int holds_halves(const struct image_channel *channel, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		uint32_t bits;

		memcpy(&bits, &channel->values[i], sizeof(bits));
		if (bits & 0x1fff) /* a half has 10 bits of fraction, a float 23 */
			return 0;
	}
	return 1;
}

/** The stored value of an effect channel, or what its absence means. */
static double effect_at(const struct image_channel *channel, size_t i, double absent)
{
	return channel ? (double)channel->values[i] : absent;
}

/* The six layers of one colour: beauty, gl, shadow, relight, reflect, refract. */
enum { LAYER_BEAUTY, LAYER_GL, LAYER_SHADOW, LAYER_RELIGHT, LAYER_REFLECT, LAYER_REFRACT, N_LAYERS };

/**
 * 1 where the renderer was told to leave out channels that could explain a difference (its --aov list stands in the
 * file): then a sum that does not close says nothing. A file without that attribute holds all the effects that it has.
 */
static int left_out_effects(const struct image *img, const char **first)
{
	static const char *const groups[] = { "shadow", "relight", "reflect", "refract" };
	const char *aov = image_attribute(img, "relume:aov");
	char list[300];

	if (!aov)
		return 0;
	snprintf(list, sizeof(list), ",%s,", aov);
	for (size_t i = 0; i < sizeof(groups) / sizeof(groups[0]); i++) {
		char wanted[16];

		snprintf(wanted, sizeof(wanted), ",%s,", groups[i]);
		if (!strstr(list, wanted)) {
			*first = groups[i];
			return 1;
		}
	}
	return 0;
}

void gate_effects(const struct score_picture *ref, const struct image *img, const struct score_options *options,
                  uint8_t *blamed, struct score *s)
{
	static const char *const names[N_LAYERS] = { "", "gl", "shadow", "relight", "reflect", "refract" };
	const struct image_channel *ch[3][N_LAYERS];
	const size_t n = (size_t)img->width * img->height;
	uint64_t open = 0, unexplained = 0, touched[N_SCORE_EFFECTS] = { 0 };
	double relative = BAR_CLOSURE_FLOAT, absolute = 1e-12, worst = 0;
	const char *left_out = NULL;
	int any_effect = 0;

	for (int c = 0; c < 3; c++) {
		for (int l = 0; l < N_LAYERS; l++) {
			ch[c][l] = find_channel(img, names[l], c);
			any_effect |= l >= LAYER_SHADOW && ch[c][l];
			if (ch[c][l] && !ch[c][l]->full_float) {
				relative = BAR_CLOSURE_HALF;
				absolute = 0x1p-23; /* four times half a step of halfs below 2^-14 */
			}
		}
		if (!ch[c][LAYER_BEAUTY] || !ch[c][LAYER_GL]) {
			for (int g = GATE_E1; g <= GATE_E3; g++)
				gate_note(s, (enum score_gate_id)g, "the frame has no channels R and gl.R");
			return;
		}
	}

	int halves = 1;

	for (int c = 0; c < 3 && halves; c++)
		halves = holds_halves(ch[c][LAYER_BEAUTY], n) && holds_halves(ch[c][LAYER_GL], n);
	if (halves) {
		relative = BAR_CLOSURE_HALF;
		absolute = 0x1p-23;
	}
	for (size_t i = 0; i < n; i++) {
		if (gate_ignores(ref, i))
			continue;
		int is_open = 0, differs = 0, effect[N_SCORE_EFFECTS] = { 0 };

		for (int c = 0; c < 3; c++) {
			double beauty = effect_at(ch[c][LAYER_BEAUTY], i, 0), gl = effect_at(ch[c][LAYER_GL], i, 0);
			double shadow = effect_at(ch[c][LAYER_SHADOW], i, 1);
			double more[3] = { effect_at(ch[c][LAYER_RELIGHT], i, 0), effect_at(ch[c][LAYER_REFLECT], i, 0),
			                   effect_at(ch[c][LAYER_REFRACT], i, 0) };
			double sum = gl * shadow + more[0] + more[1] + more[2];
			double size = fabs(gl * shadow) + fabs(more[0]) + fabs(more[1]) + fabs(more[2]);
			double bar = relative * fmax(size, fabs(beauty)) + absolute;

			is_open |= !(fabs(beauty - sum) <= bar);
			worst = fmax(worst, fabs(beauty - sum) / bar);
			differs |= !(fabs(beauty - gl) <= relative * fmax(fabs(gl), fabs(beauty)) + absolute);
			effect[EFFECT_SHADOW] |= shadow != 1;
			for (int k = 0; k < 3; k++)
				effect[EFFECT_RELIGHT + k] |= more[k] != 0;
		}
		for (int k = 0; k < EFFECT_ANY; k++)
			effect[EFFECT_ANY] |= effect[k];
		for (int k = 0; k < N_SCORE_EFFECTS; k++)
			touched[k] += (uint64_t)effect[k];
		open += (uint64_t)is_open;
		unexplained += differs && !effect[EFFECT_ANY];
		blamed[i] |= is_open || (differs && !effect[EFFECT_ANY]);
	}
	for (int k = 0; k < N_SCORE_EFFECTS; k++)
		s->info.effect_share[k] = (double)touched[k] / (double)n;

	if (open && left_out_effects(img, &left_out)) {
		gate_note(s, GATE_E1, "the frame was rendered without %s channels", left_out);
		gate_note(s, GATE_E2, "the frame was rendered without %s channels", left_out);
	} else {
		gate_measure(options, s, GATE_E1, 0, (double)open, 0);
		gate_note(s, GATE_E1, "worst is %.3g of the bar (relative %s)%s", worst, relative == BAR_CLOSURE_HALF ? "2^-9" : "1e-5",
		     any_effect ? "" : "; no effect channels: beauty must equal gl");
		gate_measure(options, s, GATE_E2, 0, (double)unexplained, 0);
	}

	int outside = 0;

	for (size_t k = 0; k < options->n_ranges; k++) {
		const struct score_range *r = &options->ranges[k];
		double share = s->info.effect_share[r->effect];
		/* an unset bound is NAN, and nothing lies beyond it */
		if (share < r->low || share > r->high) {
			outside++;
			gate_note(s, GATE_E3, "%s touches %.3f %% of the pixels", score_effect_names[r->effect], 100 * share);
		}
	}
	if (options->n_ranges)
		gate_measure(options, s, GATE_E3, 0, outside, 0);
	else
		gate_note(s, GATE_E3, "no range asked for");
}
