/* Shared parts of the gates: names and bars, their inputs, and recording of measurements. */
#pragma once

#include "diff/score/maps.h"
#include "diff/score/score.h"

struct score_figure {
	const char *name;   /* "share over 2/255" */
	const char *unit;   /* "%", "px", "" */
	int at_least;       /* 1: the bar is a lower bound, 0: an upper one */
	double bar;         /* the default */
	double share;       /* lower limit of the bar, as a share of the frame's pixels */
	const char *column; /* heading of its column in the table; NULL: no column */
};

struct score_gate_info {
	const char *name;  /* "R1b" */
	const char *title; /* "blended pixels" */
	int needs_reference;
	int n_figures;
	struct score_figure figures[SCORE_MAX_FIGURES];
};

extern const struct score_gate_info score_gates[N_GATES];
extern const char *const score_effect_names[N_SCORE_EFFECTS];

/* Inputs and intermediate results of a frame's gates. */
struct gate_frame {
	const struct score_picture *ref; /* rgb NULL: no reference */
	const struct image *img;
	const struct score_options *options;
	const struct score_approved *approved; /* NULL: none */
	const char *layer;                     /* the layer of img to compare */
	struct score *score;

	/* Not yet filled when validity is measured. */
	struct score_picture traced; /* the layer */
	struct score_maps maps;      /* empty without a reference */
	uint8_t *blamed;             /* [height][width]: gates set 1 where a pixel fails */

	/* Counts of interior, blended and band pixels (color.c). */
	struct gate_colors {
		uint64_t count[3], failing[3], gross;
		uint64_t by_alpha[3], by_range[3]; /* failing pixels of each kind that differ only in alpha, and only in
		                                      values below black or over white */
		uint64_t beyond; /* pixels off by more than R1 allows, including edges */
	} colors;
	/* Pixels where the channels do not add up (effects.c). */
	struct gate_closure {
		int has_layers;  /* 0: beauty or gl is missing, and nothing is counted */
		int any_effect;  /* 1: there is an effect channel */
		double relative; /* relative tolerance of sums */
		double worst;    /* largest error, in multiples of the tolerance */
		uint64_t open, unexplained;
	} closure;
};

/**
 * Record one figure with its bar, or with the bar that options set. The gate fails if any figure misses its bar (NaN
 * misses every bar) or is better than its `better` bound. It warns if a figure only misses the bar for warnings.
 */
void gate_measure(const struct gate_frame *f, enum score_gate_id id, int figure, double value);

/** Set the gate's note. */
void gate_note(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));

/** Fail the gate, whatever its figures; the note says why. */
void gate_fail(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));
