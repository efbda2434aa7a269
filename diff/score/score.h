/*
 * The score of one frame: how well a traced picture agrees with its reference, gate by gate.
 *
 * The gates ask separate questions. Is the geometry right (R4, R5)? Is OpenGL's own shading right (R1 to R3 and P, on
 * the gl channels)? Do the effect channels explain what the beauty adds (E1 to E3), is nothing darker than its shadows
 * explain, and nothing burnt out (N)? With an approved frame, gate B asks: is everything as it was when the frame was
 * approved?
 *
 * Conventions
 *   codes    display-referred numbers of 8 bits; linear channels go through sRGB's curve and are rounded half to even
 *   alpha    of pictures from other programs: compared, with colours multiplied by it; pictures without it are opaque
 *            (pair.h)
 *   range    between two linear pictures, values below 0 and above 1 have codes as well (pair.h); elsewhere they are
 *            clamped
 *   rows     the top row first, as in image.h
 *   edges    a pixel is in the edge band if one of its 8 neighbours has another id, or if window depth bends at it:
 *            |z[-1] - 2 z[0] + z[+1]| > SCORE_DEPTH_EPSILON + max(|z[+1] - z[0]|, |z[0] - z[-1]|) / 8 along x or y. A
 *            plane has no second difference in window space (GL 2.1 equation 3.9 is linear there): this finds creases
 *            and silhouettes, not slopes. It uses the traced frame's id and depth, and the reference's depth if any.
 *            All other pixels are interior: further than 1 px from an edge. In pictures with neither id nor depth,
 *            every pixel is interior.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "diff/score/gate_table.h"
#include "scene/draw_names.h"
#include "tracer/image/image.h"

#define SCORE_DEPTH_EPSILON (1.0 / (1 << 21))       /* 8 steps of a 24-bit depth buffer */
#define SCORE_DEPTH_EPSILON_16 (1.0 / (1 << 13))    /* 8 steps of a 16-bit one */

#define SCORE_GATE_ID(id, ...) GATE_##id,
enum score_gate_id { SCORE_GATES(SCORE_GATE_ID) N_GATES };

/* NOT_MEASURED is not PASSED: the inputs lack data that the gate needs. WARNED does not affect the outcome. */
enum score_state { SCORE_NOT_MEASURED, SCORE_PASSED, SCORE_WARNED, SCORE_FAILED, N_SCORE_STATES };

extern const char *const score_state_names[N_SCORE_STATES];

#define SCORE_CODES 2 /* R1, R2: the largest channel difference that passes, codes */

#define SCORE_MAX_PROGRAMS 64
#define SCORE_PROGRAM_NAME 32

enum { SCORE_MAX_FIGURES = 3, SCORE_MAX_BLAME = 8, SCORE_MAX_RANGES = 4 };

/* One gate of one frame; figures as in gate_table.h. */
struct score_gate {
	enum score_state state;
	double value[SCORE_MAX_FIGURES], bar[SCORE_MAX_FIGURES]; /* valid unless NOT_MEASURED */
	int better_than_expected; /* 1: it failed because a figure was better than expected */
	char note[160]; /* reason for failing or not measuring, or the method of measuring; may be empty */
};

enum score_outcome {
	SCORE_FRAME_PASSED,
	SCORE_FRAME_FAILED,
	SCORE_FRAME_FLAKY,      /* failed only gates that the rules list as flaky */
	SCORE_FRAME_NEW,        /* passed; a baseline was given and has no such frame */
	SCORE_FRAME_MISSING,    /* there is a reference, but no traced frame */
	SCORE_FRAME_EXTRA,      /* there is a traced frame, but no reference */
	SCORE_FRAME_UNREADABLE, /* one of the two files could not be read */
	N_SCORE_OUTCOMES
};

extern const char *const score_outcome_names[N_SCORE_OUTCOMES];

#define SCORE_EFFECT_ID(id, name) EFFECT_##id,
enum score_effect { SCORE_EFFECTS(SCORE_EFFECT_ID) N_SCORE_EFFECTS };

/* Figures that do not affect the outcome; NAN if not measured. */
struct score_info {
	double gl_psnr_db, gl_ssim;               /* compared channels against the reference */
	double gl_rmse, gl_mrse, gl_yee;          /* rmse in [0,1]; gl_yee: pixels that Yee's metric sees, if requested */
	double beauty_flip, beauty_psnr_db;       /* beauty against the reference */
	double beauty_ms_ssim, beauty_ciede_p95;
	double effect_share[N_SCORE_EFFECTS];     /* share of pixels, [0,1], touched by each effect */
};

struct score_blame {
	uint32_t draw;        /* id */
	uint64_t pixels;      /* failing pixels it holds */
	struct draw_name name; /* its name in the recording */
	int is_approved;      /* 1: the approved frame shows this draw at these pixels; the traced frame shows another */
	uint32_t x0, y0, x1, y1; /* box around its failing pixels, inclusive */
};

/* One of the recorded application's own programs. */
struct score_program {
	char name[SCORE_PROGRAM_NAME]; /* "program object 7" */
	uint64_t pixels, failing;      /* pixels that its draws show, and those of them that fail R1, R1b or R2 */
};

struct score {
	uint64_t frame;
	enum score_outcome outcome;
	uint32_t width, height; /* size of the reference */
	char layer[32];         /* the compared layer: "gl", "beauty", ...; empty if none */
	struct score_gate gates[N_GATES];
	double fidelity;        /* share of pixels, [0,1], that pass R1, R1b or R2; 0 if nothing was compared */
	uint64_t failing_pixels; /* pixels that fail R1, R1b or R2 */
	uint64_t blamed_pixels;  /* pixels that fail any gate */
	uint32_t worst;         /* largest channel difference of any pixel, codes */
	struct score_info info;
	uint32_t n_blame;
	struct score_blame blame[SCORE_MAX_BLAME]; /* draws with most blamed pixels, in falling order; none without ids */
	uint32_t n_programs;
	struct score_program programs[SCORE_MAX_PROGRAMS]; /* those that show somewhere; the first ones if there are more */
	const char *flaky_reason; /* borrowed from the configuration; NULL: nothing is flaky */
};

/* Sources of a picture's codes, for pair.h; all borrowed. rgb NULL: not known. */
struct score_numbers {
	const float *rgb[3], *alpha; /* alpha NULL: the layer has none */
	int is_display;  /* 1: display-referred numbers, 0: linear light */
	int is_straight; /* 1: colours are not multiplied by alpha */
	int is_frame;    /* 1: a frame of Relume or its reference, whose alpha is invisible */
};

/* One side of a comparison. Planes are borrowed, NULL if the picture has none. */
struct score_picture {
	uint32_t width, height;
	uint8_t *rgb;          /* [height][width][3], codes; owned */
	uint8_t *alpha;        /* [height][width], codes; owned; NULL: not compared (pair.h) */
	int16_t *beyond;       /* [height][width][3]: how far codes are below 0 or above 255; owned; NULL: none are (pair.h) */
	struct score_numbers numbers;
	const float *depth;    /* window depth, [0,1] */
	const float *id;       /* draw number, 0: none */
	const float *layers;   /* number of blended layers on the pixel */
	const uint8_t *outside; /* 1 where its file has no pixel; borrowed */
	const uint8_t *ignore; /* in a reference: 1 where nothing is compared (a clock, a version number); borrowed */
	const char *recording; /* in a reference: hash of its trace; NULL or "" if not known; borrowed */
};

/** The approved frame that gate B compares with. */
struct score_approved {
	const struct image *image; /* NULL: its pixels are not stored */
	int same_device;           /* 1: from the device that the traced frame names */
	int same_hashes;           /* 1: all channels have the approved hashes, so nothing needs measuring */
	char changed[96];          /* names of channels with other hashes; may be truncated */
	int same_channels;         /* 1: both have the same channel names */
};

/** Gate E3: the share of pixels, [0,1], that an effect must touch; NAN: no bound. */
struct score_range {
	enum score_effect effect;
	double low, high;
};

/** A bar in place of the default one. NAN: not given. */
struct score_bar {
	enum score_gate_id gate;
	int figure;
	double bar;    /* the gate fails beyond it */
	double warn;   /* the gate warns beyond it */
	double better; /* the gate fails on the good side of it: an unexpected improvement is a finding */
};

/* All zero: the default bars. */
struct score_options {
	struct score_range ranges[SCORE_MAX_RANGES];
	size_t n_ranges;
	const struct score_bar *bars; /* borrowed; later ones win */
	size_t n_bars;
	double codes;                 /* replaces SCORE_CODES; 0: that default */
	const char *const *channels;  /* borrowed; names of required channels (V) */
	size_t n_channels;
	int ignore_alpha;             /* 1: alpha is not compared, and colours are compared as stored */
	/* Yee's metric (oiio_compare_yee), which is slow; NULL: skip. Passed in, as scoring does not know
	 * OpenImageIO. */
	int (*yee)(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count);
	const char *channel; /* layer to compare: "gl", "beauty", or any; NULL: gl if present, else beauty */
};

/**
 * Score one traced frame.
 *
 * @param ref     the reference; receives the codes of the pair (pair.h)
 * @param img     the traced frame; any size and content
 * @param frame   expected frame number of `img`
 * @param approved  the approved frame, for gate B; NULL: B is not measured
 * @param out     filled; outcome is PASSED or FAILED
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_frame(struct score_picture *ref, const struct image *img, uint64_t frame,
                const struct score_options *options, const struct score_approved *approved, struct score *out);
