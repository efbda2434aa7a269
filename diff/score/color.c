/* Gates R1, R1b, R2 and R3: count pixels that differ in colour. Gate P: perceived difference. */
#include "diff/score/measures.h"

#include <inttypes.h>
#include <math.h>

#include "diff/score/flip.h"
#include "diff/score/pair.h"

#define GROSS_CODES 32 /* R3: the largest residual that is no gross error */

enum { INTERIOR, BLENDED, BAND }; /* kinds of pixels: the index in struct gate_colors */

void gate_count_colors(struct gate_frame *f)
{
	const size_t n = (size_t)f->ref->width * f->ref->height;
	const struct score_maps *maps = &f->maps;
	struct gate_colors *c = &f->colors;
	struct score *s = f->score;

	for (size_t i = 0; i < n; i++) {
		if (score_ignores(f->ref, i))
			continue;
		int kind = maps->band[i] ? BAND : score_layers_at(&f->traced, i) > 0 ? BLENDED : INTERIOR;

		c->count[kind]++;
		c->failing[kind] += maps->failing[i];
		if (maps->failing[i] && score_code_difference(f->ref->rgb + 3 * i, f->traced.rgb + 3 * i) <=
		                                score_allowed(f->options, &f->traced, i))
			*(score_alpha_difference(f->ref, i, &f->traced, i) >= maps->difference[i] ?
			          &c->by_alpha[kind] :
			          &c->by_range[kind]) += 1;
		c->beyond += maps->difference[i] > score_allowed(f->options, &f->traced, i);
		c->gross += maps->residual[i] > GROSS_CODES;
		s->worst = maps->difference[i] > s->worst ? maps->difference[i] : s->worst;
	}
	s->failing_pixels = c->failing[INTERIOR] + c->failing[BLENDED] + c->failing[BAND];
	s->fidelity = 1 - (double)s->failing_pixels /
	                          fmax(1, (double)(c->count[INTERIOR] + c->count[BLENDED] + c->count[BAND]));
}

/*
 * Measure the share of pixels of one kind that fail, or that pass if the bar is a lower bound.
 * @param none    the note if there are no such pixels
 * @param pixels  their name in the note: "interior pixels"
 */
static int measure_kind(struct gate_frame *f, enum score_gate_id id, int kind, const char *none, const char *pixels)
{
	const uint64_t n = f->colors.count[kind], failing = f->colors.failing[kind];
	const double share = 100 * (double)failing / (double)n;

	if (!n) {
		gate_note(f, id, "%s", none);
		return 0;
	}
	gate_measure(f, id, 0, score_gates[id].figures[0].at_least ? 100 - share : share);
	gate_note(f, id, "%" PRIu64 " of %" PRIu64 " %s", failing, n, pixels);
	if (f->colors.by_alpha[kind] && failing)
		gate_note(f, id, "%" PRIu64 " of %" PRIu64 " %s; %" PRIu64 " in alpha alone (--ignore-alpha)", failing,
		          n, pixels, f->colors.by_alpha[kind]);
	else if (f->colors.by_range[kind] && failing)
		gate_note(f, id, "%" PRIu64 " of %" PRIu64 " %s; %" PRIu64 " by values over white or below black alone",
		          failing, n, pixels, f->colors.by_range[kind]);
	return 0;
}

int gate_interior(struct gate_frame *f)
{
	return measure_kind(f, GATE_R1, INTERIOR, "no pixel is interior", "interior pixels");
}

int gate_blended(struct gate_frame *f)
{
	return measure_kind(f, GATE_R1B, BLENDED, f->traced.layers ? "nothing is blended"
	                    : "the frame has no channel \"layers\"; blended pixels count in R1", "blended pixels");
}

int gate_band(struct gate_frame *f)
{
	return measure_kind(f, GATE_R2, BAND, f->traced.id || f->traced.depth ? "there are no edges"
	                    : "neither id nor depth: all pixels count in R1", "band pixels fail");
}

int gate_gross(struct gate_frame *f)
{
	gate_measure(f, GATE_R3, 0, (double)f->colors.gross);
	gate_note(f, GATE_R3, "worst pixel %u/255", f->score->worst);
	return 0;
}

/* 1 if options set a bar for the gate. */
static int has_own_bar(const struct score_options *options, enum score_gate_id id)
{
	for (size_t i = 0; i < options->n_bars; i++)
		if (options->bars[i].gate == id && !isnan(options->bars[i].bar))
			return 1;
	return 0;
}

/* FLIP reacts to a drift of 1/255 over a whole picture, which is normal between two rasterizers. A drift alone does not
 * fail. */
int gate_perceptual(struct gate_frame *f)
{
	struct score_gate *g = &f->score->gates[GATE_P];
	double flip;
	int err = flip_compare(f->ref->rgb, f->traced.rgb, f->ref->width, f->ref->height, NULL, &flip);

	if (err)
		return err;
	gate_measure(f, GATE_P, 0, flip);
	if (g->state == SCORE_FAILED && !g->better_than_expected && !f->colors.beyond && !has_own_bar(f->options, GATE_P)) {
		g->state = SCORE_PASSED;
		gate_note(f, GATE_P, "over its bar, but no pixel is off by more than R1 allows");
	}
	return 0;
}
