/* Gates E1 to E3: do the effects add up to the beauty, do they explain its differences, and is there enough of each? */
#include "diff/score/measures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "diff/score/picture.h"

/* Tolerance of a sum relative to the size of its terms, for layers stored as halves and as floats. */
#define TOLERANCE_HALF 0x1p-9
#define TOLERANCE_FLOAT 1e-5

static const struct image_channel *find_channel(const struct image *img, const char *layer, int c)
{
	char name[80];

	snprintf(name, sizeof(name), layer[0] ? "%s.%c" : "%s%c", layer, "RGB"[c]);
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return &img->channels[i];
	return NULL;
}

/** 1 if all numbers of a channel are halves, however stored: other tools widen them when rewriting a file. */
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

/** The stored value of a channel, or `absent` if there is no such channel. */
static double value_at(const struct image_channel *channel, size_t i, double absent)
{
	return channel ? (double)channel->values[i] : absent;
}

/* The layers of one colour. They satisfy beauty = gl * shadow + relight + reflect + refract. */
enum { LAYER_BEAUTY, LAYER_GL, LAYER_SHADOW, LAYER_RELIGHT, LAYER_REFLECT, LAYER_REFRACT, N_LAYERS };

/**
 * 1 if the renderer left out effect channels, so that an open sum means nothing. The file holds the renderer's --aov
 * list; a file without one holds every effect that occurred.
 * @param first  receives the name of the first effect left out
 */
static int find_left_out(const struct image *img, const char **first)
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

/* The layers of a frame, and the tolerance of their sums: relative * size of the terms + absolute. */
struct layers {
	const struct image_channel *channels[3][N_LAYERS]; /* [colour][layer]; NULL: the frame has no such channel */
	double relative, absolute;
	int any_effect; /* 1: there is an effect channel */
};

/** Find the layers, and the tolerance that suits their precision. @return 0 if beauty or gl is missing */
static int find_layers(const struct image *img, struct layers *out)
{
	static const char *const names[N_LAYERS] = { "", "gl", "shadow", "relight", "reflect", "refract" };
	const size_t n = (size_t)img->width * img->height;
	int halves = 0, all_halves = 1;

	*out = (struct layers){ .relative = TOLERANCE_FLOAT, .absolute = 1e-12 };
	for (int c = 0; c < 3; c++)
		for (int l = 0; l < N_LAYERS; l++) {
			const struct image_channel *channel = find_channel(img, names[l], c);

			out->channels[c][l] = channel;
			out->any_effect |= l >= LAYER_SHADOW && channel;
			halves |= channel && !channel->full_float;
			if (!channel && l <= LAYER_GL)
				return 0;
		}
	for (int c = 0; c < 3 && all_halves && !halves; c++)
		all_halves = holds_halves(out->channels[c][LAYER_BEAUTY], n) && holds_halves(out->channels[c][LAYER_GL], n);
	if (halves || all_halves) {
		out->relative = TOLERANCE_HALF;
		out->absolute = 0x1p-23; /* four roundings: below 2^-14, halves are 2^-24 apart, and rounding is off by 2^-25 */
	}
	return 1;
}

/* Findings for one pixel: bit EFFECT_x is set if that effect touches it. Above these: the layers do not add up to the
 * beauty; the beauty differs from gl. */
enum { PIXEL_OPEN = 1 << N_SCORE_EFFECTS, PIXEL_DIFFERS = 2 << N_SCORE_EFFECTS };

/*
 * Check the sum of a pixel's layers. Comparisons are negated so that NaN counts as a fault.
 * @param worst  raised to the pixel's error if that is larger, in multiples of the tolerance
 * @return the findings, as bits
 */
static unsigned check_pixel(const struct layers *l, size_t i, double *worst)
{
	unsigned found = 0;

	for (int c = 0; c < 3; c++) {
		const struct image_channel *const *ch = l->channels[c];
		double beauty = value_at(ch[LAYER_BEAUTY], i, 0), gl = value_at(ch[LAYER_GL], i, 0);
		double shadow = value_at(ch[LAYER_SHADOW], i, 1);
		double more[3] = { value_at(ch[LAYER_RELIGHT], i, 0), value_at(ch[LAYER_REFLECT], i, 0),
			           value_at(ch[LAYER_REFRACT], i, 0) };
		double sum = gl * shadow + more[0] + more[1] + more[2];
		double size = fabs(gl * shadow) + fabs(more[0]) + fabs(more[1]) + fabs(more[2]);
		double allowed = l->relative * fmax(size, fabs(beauty)) + l->absolute;

		if (!(fabs(beauty - sum) <= allowed))
			found |= PIXEL_OPEN;
		*worst = fmax(*worst, fabs(beauty - sum) / allowed);
		if (!(fabs(beauty - gl) <= l->relative * fmax(fabs(gl), fabs(beauty)) + l->absolute))
			found |= PIXEL_DIFFERS;
		found |= shadow != 1 ? 1u << EFFECT_SHADOW : 0;
		for (int k = 0; k < 3; k++)
			found |= more[k] != 0 ? 1u << (EFFECT_RELIGHT + k) : 0;
	}
	return found & ((1u << EFFECT_ANY) - 1) ? found | 1u << EFFECT_ANY : found;
}

void gate_count_effects(struct gate_frame *f)
{
	const size_t n = (size_t)f->img->width * f->img->height;
	uint64_t touched[N_SCORE_EFFECTS] = { 0 };
	struct gate_closure *closure = &f->closure;
	struct layers layers;

	closure->has_layers = find_layers(f->img, &layers);
	if (!closure->has_layers)
		return;
	closure->relative = layers.relative;
	closure->any_effect = layers.any_effect;
	for (size_t i = 0; i < n; i++) {
		unsigned found;
		int is_open, is_unexplained;

		if (score_ignores(f->ref, i))
			continue;
		found = check_pixel(&layers, i, &closure->worst);
		is_open = !!(found & PIXEL_OPEN);
		is_unexplained = found & PIXEL_DIFFERS && !(found & 1u << EFFECT_ANY);
		for (int k = 0; k < N_SCORE_EFFECTS; k++)
			touched[k] += found >> k & 1;
		closure->open += (uint64_t)is_open;
		closure->unexplained += (uint64_t)is_unexplained;
		f->blamed[i] |= is_open || is_unexplained;
	}
	for (int k = 0; k < N_SCORE_EFFECTS; k++)
		f->score->info.effect_share[k] = (double)touched[k] / (double)n;
}

/** 1 if sums of the frame's layers are meaningful; otherwise sets the gate's note to the reason. */
static int can_close(struct gate_frame *f, enum score_gate_id id)
{
	const char *left_out = NULL;

	if (!f->closure.has_layers)
		gate_note(f, id, "the frame has no channels R and gl.R");
	else if (f->closure.open && image_attribute(f->img, "relume:denoised"))
		gate_note(f, id, "the beauty is denoised, so channels of effects do not add up to it");
	else if (f->closure.open && find_left_out(f->img, &left_out))
		gate_note(f, id, "the frame was rendered without %s channels", left_out);
	else
		return 1;
	return 0;
}

int gate_closure(struct gate_frame *f)
{
	if (!can_close(f, GATE_E1))
		return 0;
	gate_measure(f, GATE_E1, 0, (double)f->closure.open);
	gate_note(f, GATE_E1, "worst is %.3g of the bar (relative %s)%s", f->closure.worst,
	          f->closure.relative == TOLERANCE_HALF ? "2^-9" : "1e-5",
	          f->closure.any_effect ? "" : "; no effect channels: beauty must equal gl");
	return 0;
}

int gate_unexplained(struct gate_frame *f)
{
	if (can_close(f, GATE_E2))
		gate_measure(f, GATE_E2, 0, (double)f->closure.unexplained);
	return 0;
}

int gate_ranges(struct gate_frame *f)
{
	char text[256] = "";
	int outside = 0;

	if (!f->closure.has_layers || !f->options->n_ranges) {
		gate_note(f, GATE_E3, f->closure.has_layers ? "no range asked for" : "the frame has no channels R and gl.R");
		return 0;
	}
	for (size_t k = 0; k < f->options->n_ranges; k++) {
		const struct score_range *r = &f->options->ranges[k];
		double share = f->score->info.effect_share[r->effect];

		/* an unset bound is NAN, so nothing is beyond it */
		if (share < r->low || share > r->high) {
			const size_t n = strlen(text);

			snprintf(text + n, sizeof(text) - n, "%s%s touches %.3f %%", outside ? ", " : "",
			         score_effect_names[r->effect], 100 * share);
			outside++;
		}
	}
	if (outside)
		gate_note(f, GATE_E3, "%s of the pixels", text);
	gate_measure(f, GATE_E3, 0, outside);
	return 0;
}
