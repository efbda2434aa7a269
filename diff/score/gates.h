/*
 * What the gates share: their names and bars, what they look at, and entering what they measured.
 */
#pragma once

#include "diff/score/maps.h"
#include "diff/score/score.h"

struct score_figure {
	const char *name;   /* "share over 2/255" */
	const char *unit;   /* "%", "px", "" */
	int at_least;       /* 1: the bar is a lower bound, 0: an upper one */
	double bar;         /* the default one */
	double share;       /* the bar is no lower than this share of the frame's pixels */
	const char *column; /* its heading in the table; NULL: it has none */
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

/* A frame, as the gates see it. */
struct gate_frame {
	const struct score_picture *ref; /* rgb NULL: there is no reference */
	const struct image *img;
	const struct score_options *options;
	const struct score_approved *approved; /* NULL: there is none */
	const char *layer;                     /* of img, that is compared */
	struct score *score;

	/* Not yet there when validity is measured. */
	struct score_picture traced; /* the layer */
	struct score_maps maps;      /* empty without a reference */
	uint8_t *blamed;             /* [height][width]: gates set 1 where a pixel fails */

	/* Interior, blended and band pixels, as color.c counts them. */
	struct gate_colors {
		uint64_t count[3], failing[3], gross;
		uint64_t by_alpha[3], by_range[3]; /* of the failing ones, by kind: by alpha alone, and by values below
		                                      black or over white alone */
		uint64_t beyond; /* further off than R1 allows, edges not excused */
	} colors;
	/* Pixels where the channels do not add up, as effects.c counts them. */
	struct gate_closure {
		int has_layers;  /* 0: beauty or gl is missing, and nothing is counted */
		int any_effect;  /* 1: there is an effect channel */
		double relative; /* how far numbers may be off */
		double worst;    /* largest error, in units of what is allowed */
		uint64_t open, unexplained;
	} closure;
};

/**
 * Enter one figure beside its bar, or beside the one that options give in its place. The gate fails where any figure
 * misses its bar (NaN misses every bar) or is better than was thought possible. It warns where it misses only the
 * bar for warnings.
 */
void gate_measure(const struct gate_frame *f, enum score_gate_id id, int figure, double value);

/** Set the gate's note. */
void gate_note(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));

/** Fail the gate, whatever its figures; the note says why. */
void gate_fail(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
	__attribute__((format(printf, 3, 4)));
