/* Gates R1, R1b, R2 and R3: how many pixels are off in colour. Gate P: how it looks. */
#include "diff/score/measures.h"

#include <inttypes.h>
#include <math.h>

#include "diff/score/flip.h"
#include "diff/score/picture.h"

#define GROSS_CODES 32 /* R3 */

enum { INTERIOR, BLENDED, BAND };

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
		c->gross += maps->residual[i] > GROSS_CODES;
		s->worst = maps->difference[i] > s->worst ? maps->difference[i] : s->worst;
	}
	s->failing_pixels = c->failing[INTERIOR] + c->failing[BLENDED] + c->failing[BAND];
	s->fidelity = 1 - (double)s->failing_pixels / fmax(1, (double)(c->count[INTERIOR] + c->count[BLENDED] + c->count[BAND]));
}

/** The share of pixels of one kind that fail. */
static double failing_share(const struct gate_frame *f, int kind)
{
	return 100 * (double)f->colors.failing[kind] / (double)f->colors.count[kind];
}

int gate_interior(struct gate_frame *f)
{
	const struct gate_colors *c = &f->colors;

	if (!c->count[INTERIOR]) {
		gate_note(f, GATE_R1, "no pixel is interior");
		return 0;
	}
	gate_measure(f, GATE_R1, 0, failing_share(f, INTERIOR));
	gate_note(f, GATE_R1, "%" PRIu64 " of %" PRIu64 " interior pixels", c->failing[INTERIOR], c->count[INTERIOR]);
	return 0;
}

int gate_blended(struct gate_frame *f)
{
	const struct gate_colors *c = &f->colors;

	if (!c->count[BLENDED]) {
		gate_note(f, GATE_R1B, f->traced.layers ? "nothing is blended"
		                                        : "the frame has no channel \"layers\"; blended pixels count in R1");
		return 0;
	}
	gate_measure(f, GATE_R1B, 0, failing_share(f, BLENDED));
	gate_note(f, GATE_R1B, "%" PRIu64 " of %" PRIu64 " blended pixels", c->failing[BLENDED], c->count[BLENDED]);
	return 0;
}

int gate_band(struct gate_frame *f)
{
	const struct gate_colors *c = &f->colors;

	if (!c->count[BAND]) {
		gate_note(f, GATE_R2, f->traced.id || f->traced.depth ? "there are no edges"
		                                                      : "neither id nor depth: all pixels count in R1");
		return 0;
	}
	gate_measure(f, GATE_R2, 0, 100 - failing_share(f, BAND));
	gate_note(f, GATE_R2, "%" PRIu64 " of %" PRIu64 " band pixels fail", c->failing[BAND], c->count[BAND]);
	return 0;
}

int gate_gross(struct gate_frame *f)
{
	gate_measure(f, GATE_R3, 0, (double)f->colors.gross);
	gate_note(f, GATE_R3, "worst pixel %u/255", f->score->worst);
	return 0;
}

int gate_perceptual(struct gate_frame *f)
{
	double flip;
	int err = flip_compare(f->ref->rgb, f->traced.rgb, f->ref->width, f->ref->height, NULL, &flip);

	if (!err)
		gate_measure(f, GATE_P, 0, flip);
	return err;
}
