/* Shared by the gates: the table that describes them, the frame that they judge, and calls that record results. */
#pragma once

#include "diff/score/maps.h"
#include "diff/score/score.h"

struct score_figure {
	const char *name;   /* "share over 2/255" */
	const char *unit;   /* "%", "px", "" */
	int at_least;       /* 1: the bar is a lower bound, 0: an upper one */
	double bar;         /* the default */
	double share;       /* raises the default to this share of the frame's pixels, if that is more */
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

/* One frame: inputs of its gates, and results that several gates use. */
struct gate_frame {
	const struct score_picture *ref; /* rgb NULL: no reference */
	const struct image *img;
	const struct score_options *options;
	const struct score_approved *approved; /* NULL: none */
	const char *layer;                     /* the layer of img to compare */
	struct score *score;

	/* Filled once gate V has passed. */
	struct score_picture traced; /* the layer */
	struct score_maps maps;      /* empty without a reference */
	uint8_t *blamed;             /* [height][width]: gates set 1 where a pixel fails */

	/* Pixel counts of gates R1 to R3 (color.c). Arrays: interior, blended and band pixels. */
	struct gate_colors {
		uint64_t count[3];    /* all pixels of this kind */
		uint64_t failing[3];  /* those that fail R1, R1b or R2 */
		uint64_t by_alpha[3]; /* those that fail only because alpha differs */
		uint64_t by_range[3]; /* those that fail only because of values below black or over white */
		uint64_t gross;       /* pixels with a residual (maps.h) that R3 does not allow */
		uint64_t beyond;      /* pixels off by more than R1 allows, including edges */
	} colors;
	/* Whether gl and the effect channels add up to the beauty (effects.c). */
	struct gate_closure {
		int has_layers;  /* 0: beauty or gl is missing, and nothing is counted */
		int any_effect;  /* 1: there is an effect channel */
		double relative; /* relative tolerance of sums */
		double worst;    /* largest error, in multiples of the tolerance */
		uint64_t open;        /* pixels where they do not add up (E1) */
		uint64_t unexplained; /* pixels that differ from gl although no effect touches them (E2) */
	} closure;
};

/**
 * Record one figure with its bar: the default, or the one that options set. The gate fails if a figure misses its bar
 * (NaN misses every bar) or is better than `better` of struct score_bar. It warns if a figure misses only `warn`.
 * @param figure  index among the gate's figures in gate_table.h
 */
void gate_measure(const struct gate_frame *f, enum score_gate_id id, int figure, double value);

/** Set the gate's note, in place of an earlier one; cut to the size of struct score_gate's. */
void gate_note(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));

/** Fail the gate, whatever its figures. The note gives the reason. */
void gate_fail(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));
