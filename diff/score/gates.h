/* What the gates share: entering figures, and differences of codes. Only the gates' own files include it. */
#ifndef DIFF_SCORE_GATES_H
#define DIFF_SCORE_GATES_H

#include <math.h>
#include <stdlib.h>

#include "diff/score/score.h"

/**
 * Enter one figure beside its bar, or beside the one that options give in its place. The gate fails where any figure
 * misses its bar (NaN misses every bar) or is better than what was thought possible, and warns where it misses only
 * the bar for warnings.
 */
void gate_measure(const struct score_options *options, struct score *s, enum score_gate_id id, int figure, double value,
                  double bar);

/** Set the gate's note. */
void gate_note(struct score *s, enum score_gate_id id, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

/** The planes of layer.R, layer.G, layer.B ("beauty": R, G, B); 0 where one is missing. */
int gate_find_layer(const struct image *img, const char *layer, const float *planes[3]);

/** 1 where the depths are all steps of a 16-bit depth buffer. */
int gate_depth_is_16_bit(const float *depth, size_t n);

/** Number of blended layers at a pixel; 0 without the channel. */
float gate_layers_at(const struct score_picture *traced, size_t i);

/** Largest difference of three codes. */
static inline int gate_code_difference(const uint8_t *a, const uint8_t *b)
{
	int worst = 0;

	for (int c = 0; c < 3; c++) {
		int d = abs(a[c] - b[c]);

		worst = d > worst ? d : worst;
	}
	return worst;
}

static inline int gate_ignores(const struct score_picture *ref, size_t i)
{
	return ref->ignore && ref->ignore[i];
}

/* One file each. All return 0 or ERR_SYSTEM (reported). `blamed` [height][width]: set to 1 where a pixel fails. */

/** R4 (silhouette.c). */
int gate_silhouette(const struct score_picture *ref, const struct score_picture *traced,
                    const struct score_options *options, struct score *s);

/** E1 to E3 (effects.c). */
void gate_effects(const struct score_picture *ref, const struct image *img, const struct score_options *options,
                  uint8_t *blamed, struct score *s);

/** B (approved.c). */
int gate_baseline(const struct score_picture *ref, const struct image *img, const struct score_approved *approved,
                  const struct score_options *options, uint8_t *blamed, struct score *s);

/** Which draws hold the blamed pixels (blame.c); `approved` may be NULL. */
int gate_blame(const struct score_picture *traced, const struct score_approved *approved, const uint8_t *blamed,
               size_t n, struct score *s);

#endif
