/*
 * The score of one frame: how well a traced picture agrees with its reference, gate by gate.
 *
 * Three questions are asked apart: is the geometry right (R4, R5), is OpenGL's own shading right (R1 to R3, P, on the
 * picture's gl channels), and is what the beauty adds to it explained by the effect channels (E1 to E3). A fourth one, B,
 * is asked where there is an approved frame: is everything as it was when somebody looked at it.
 *
 * Conventions
 *   codes    display-referred numbers of 8 bits; linear channels go through sRGB's curve and are rounded half to even
 *   rows     the top row first, as in image.h
 *   edges    a pixel is in the edge band when one of its 8 neighbours has another id, or when window depth bends at it:
 *            |z[-1] - 2 z[0] + z[+1]| > SCORE_DEPTH_EPSILON + max(|z[+1] - z[0]|, |z[0] - z[-1]|) / 8 along x or y. A
 *            plane has no second difference in window space (GL 2.1 equation 3.9 is linear there), so that creases
 *            and silhouettes are found and slopes are not. The traced frame's id and depth count, and the reference's
 *            depth where there is one. All other pixels are interior: further than 1 px from an edge.
 *            Pictures with neither id nor depth have no edges: all their pixels are interior.
 */
#ifndef DIFF_SCORE_SCORE_H
#define DIFF_SCORE_SCORE_H

#include <stddef.h>
#include <stdint.h>

#include "scene/draw_names.h"
#include "tracer/image/image.h"

#define SCORE_DEPTH_EPSILON (1.0 / (1 << 21))       /* 8 steps of a 24-bit depth buffer */
#define SCORE_DEPTH_EPSILON_16 (1.0 / (1 << 13))    /* 8 steps of a 16-bit one */

enum score_gate_id {
	GATE_V, GATE_R1, GATE_R1B, GATE_R2, GATE_R3, GATE_R4, GATE_R5, GATE_E1, GATE_E2, GATE_E3, GATE_P, GATE_B, N_GATES
};

/* NOT_MEASURED is not PASSED: it says that the inputs do not hold what the gate looks at. WARNED decides nothing. */
enum score_state { SCORE_NOT_MEASURED, SCORE_PASSED, SCORE_WARNED, SCORE_FAILED, N_SCORE_STATES };

extern const char *const score_state_names[N_SCORE_STATES];

#define SCORE_CODES 2 /* R1, R2: largest channel difference that passes, codes */

enum { SCORE_MAX_FIGURES = 2, SCORE_MAX_BLAME = 8, SCORE_MAX_RANGES = 4 };

/* What a gate measures; the order of figures is that of struct score_gate. */
struct score_gate_info {
	const char *name;  /* "R1b" */
	const char *title; /* "blended pixels" */
	int n_figures;
	struct {
		const char *name; /* "share over 2/255" */
		const char *unit; /* "%", "px", "" */
		int at_least;     /* 1: the bar is a lower bound, 0: an upper one */
	} figures[SCORE_MAX_FIGURES];
};

extern const struct score_gate_info score_gates[N_GATES];

struct score_gate {
	enum score_state state;
	double value[SCORE_MAX_FIGURES], bar[SCORE_MAX_FIGURES]; /* valid unless NOT_MEASURED */
	int better_than_expected; /* 1: that is why it failed */
	char note[160]; /* why it failed or was not measured, or how it was measured; may be empty */
};

enum score_outcome {
	SCORE_FRAME_PASSED,
	SCORE_FRAME_FAILED,
	SCORE_FRAME_FLAKY,      /* failed, but only gates that are listed as known to be flaky */
	SCORE_FRAME_NEW,        /* passed, but there is no approved frame where one is asked for */
	SCORE_FRAME_MISSING,    /* there is a reference, but no traced frame */
	SCORE_FRAME_EXTRA,      /* there is a traced frame, but no reference */
	SCORE_FRAME_UNREADABLE, /* one of the two files could not be read */
	N_SCORE_OUTCOMES
};

extern const char *const score_outcome_names[N_SCORE_OUTCOMES];

enum score_effect { EFFECT_SHADOW, EFFECT_RELIGHT, EFFECT_REFLECT, EFFECT_REFRACT, EFFECT_ANY, N_SCORE_EFFECTS };

extern const char *const score_effect_names[N_SCORE_EFFECTS];

/* Figures that never decide; NAN where not measured. */
struct score_info {
	double gl_psnr_db, gl_ssim;               /* compared channels against the reference */
	double gl_rmse, gl_mrse, gl_yee;          /* rmse in [0,1]; gl_yee: pixels that Yee's metric sees, where asked for */
	double beauty_flip, beauty_psnr_db;       /* beauty against the reference */
	double beauty_ms_ssim, beauty_ciede_p95;
	double effect_share[N_SCORE_EFFECTS];     /* share of pixels, [0,1], that each effect touches */
};

struct score_blame {
	uint32_t draw;        /* id */
	uint64_t pixels;      /* failing ones it holds */
	struct draw_name name; /* what it was in the recording */
	int is_approved;      /* 1: the draw that the approved frame shows there; the traced frame shows another one */
	uint32_t x0, y0, x1, y1; /* box around its failing pixels, last ones included */
};

struct score {
	uint64_t frame;
	enum score_outcome outcome;
	uint32_t width, height; /* of the reference */
	char layer[32];         /* the layer that was compared: "gl", "beauty", ...; empty where nothing was */
	struct score_gate gates[N_GATES];
	double fidelity;        /* share of pixels, [0,1], that pass R1, R1b or R2; 0 where nothing was compared */
	uint64_t failing_pixels; /* of R1, R1b and R2 */
	uint64_t blamed_pixels;  /* that fail any gate that looks at pixels */
	uint32_t worst;         /* largest channel difference of any pixel, codes */
	struct score_info info;
	uint32_t n_blame;
	struct score_blame blame[SCORE_MAX_BLAME]; /* draws by blamed pixels, most first; none without ids */
	const char *flaky_reason; /* borrowed from the configuration; NULL where nothing is flaky */
};

/* One side of a comparison. Planes are borrowed, NULL where the picture has none. */
struct score_picture {
	uint32_t width, height;
	uint8_t *rgb;          /* [height][width][3], codes; owned */
	const float *depth;    /* window depth, [0,1] */
	const float *id;       /* draw number, 0: none */
	const float *layers;   /* number of blended layers on the pixel */
	const uint8_t *ignore; /* of a reference: 1 where nothing is compared (a clock, a version number); borrowed */
};

/** The approved frame that gate B compares with. */
struct score_approved {
	const struct image *image; /* NULL: its pixels are not stored */
	int same_device;           /* 1: it came from the device that the traced frame names */
	int same_hashes;           /* 1: all channels have the approved hashes, so that nothing needs to be measured */
	char changed[96];          /* names of channels that do not; may be cut */
	int same_channels;         /* 1: the two hold channels of the same names */
};

/** Share of pixels, [0,1], that a kind of effect must touch (gate E3); NAN: no bound. */
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
	double better; /* the gate fails on the good side of it: an improvement that nobody expected is a finding */
};

/* All zero: the scoring rules' own bars. */
struct score_options {
	struct score_range ranges[SCORE_MAX_RANGES];
	size_t n_ranges;
	const struct score_bar *bars; /* borrowed; later ones win */
	size_t n_bars;
	double codes;                 /* in place of SCORE_CODES; 0: that */
	const char *const *channels;  /* borrowed; names of channels that must be there (V) */
	size_t n_channels;
	/* Yee's metric (oiio_compare_yee), which is slow; NULL: not wanted. Handed in, so that scoring does without OpenImageIO. */
	int (*yee)(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count);
	const char *channel; /* layer to compare: "gl", "beauty", or any; NULL: gl where there is one, else beauty */
};

/**
 * Take a layer out of an image as display codes, and its depth ("gl.depth"), "id" and "layers" if there.
 *
 * @param layer  "gl" means gl.R gl.G gl.B; "beauty" means R G B
 * @param out    all zero; planes are borrowed from img; free with score_picture_free
 * @return 0, ERR_INPUT (not reported: no such layer) or ERR_SYSTEM (reported)
 */
int score_picture_from_image(const struct image *img, const char *layer, struct score_picture *out);
void score_picture_free(struct score_picture *pic);

/** One linear number as a display code; NaN gives 0, beyond [0,1] is clamped. */
uint8_t score_code_from_linear(float linear);

/**
 * Score one traced frame.
 *
 * @param ref     the reference
 * @param img     the traced frame; any size and content
 * @param frame   number of the frame that `img` should be
 * @param approved  what gate B compares with; NULL: B is not measured
 * @param out     filled; outcome is PASSED or FAILED
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_frame(const struct score_picture *ref, const struct image *img, uint64_t frame,
                const struct score_options *options, const struct score_approved *approved, struct score *out);

/** Per-pixel differences, for pictures of them. Both: [height][width]. */
struct score_maps {
	uint8_t *difference; /* largest channel difference, codes, plain */
	uint8_t *residual;   /* what R2's symmetric minimum over 3x3 pixels leaves of it, codes */
	uint8_t *failing;    /* 1 where the pixel fails R1, R1b or R2 */
	uint8_t *band;       /* 1: edge band */
};

/**
 * The maps behind gates R1 to R3 of two pictures of one size.
 * @param out  all zero; free with score_maps_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int score_make_maps(const struct score_picture *ref, const struct score_picture *traced,
                    const struct score_options *options, struct score_maps *out);
void score_maps_free(struct score_maps *maps);

/* Metrics (metrics.c); pictures are [height][width][3] codes. */

/** Peak signal-to-noise ratio over all channels, dB; INFINITY where equal. */
double metric_psnr_db(const uint8_t *a, const uint8_t *b, size_t n_pixels);

/** Root of the mean squared difference over all channels, in [0,1]. */
double metric_rmse(const uint8_t *a, const uint8_t *b, size_t n_pixels);

/** Mean relative squared error over all channels, (test - ref)^2 / (ref^2 + 0.01), of linear numbers. */
double metric_mrse(const uint8_t *ref, const uint8_t *test, size_t n_pixels);

/**
 * Structural similarity on luma (Rec.709 weights on codes): Wang et al. 2004, 11x11 Gaussian of sigma 1.5, K .01 and
 * .03, mean over windows that lie inside the picture; NAN below 11 pixels or without memory.
 */
double metric_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height);

/** Multi-scale SSIM (Wang et al. 2003) over five scales; NAN below 176 pixels or without memory. */
double metric_ms_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height);

/** CIE L*a*b* (D65) of linear Rec.709. */
void metric_lab_from_linear(const double rgb[3], double lab[3]);

/** Colour difference CIEDE2000 (Sharma, Wu and Dalal 2005), all k = 1. */
double metric_ciede2000(const double lab1[3], const double lab2[3]);

/** 95th percentile of CIEDE2000 over all pixels; NAN without memory. */
double metric_ciede2000_p95(const uint8_t *a, const uint8_t *b, size_t n_pixels);

/* FLIP (flip.c). */

/** Pixels per degree at 0.7 m from a display 3840 px and 0.7 m wide. */
#define FLIP_PIXELS_PER_DEGREE 67.0206432f

/**
 * Perceived difference of two pictures when flipped between (Andersson et al., "FLIP: A Difference Evaluator for
 * Alternating Images", HPG 2020).
 *
 * @param a, b   [height][width][3], codes (sRGB)
 * @param error  receives [height][width], [0,1]; NULL: only the mean is wanted
 * @param mean   receives the mean
 * @return 0 or ERR_SYSTEM (reported)
 */
int flip_compare(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, float *error, double *mean);

/**
 * The same for linear pictures of any range: the largest error over four exposures from 2^0.083 to 2^3.557 of a film
 * curve (Andersson et al., "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021). The exposures are
 * fixed, where its authors derive them from the reference: frames stay comparable, and black ones have a score.
 *
 * @param a, b   planes R, G, B of linear Rec.709, [height][width] each
 */
int flip_compare_hdr(const float *const a[3], const float *const b[3], uint32_t width, uint32_t height, float *error,
                     double *mean);

/** Colour of a value in [0,1] on the map "magma" (matplotlib), as codes. */
void flip_magma(float value, uint8_t rgb[3]);

#endif
