/* The gates: what each measures, its bar, and the verdict. Constants are those of the scoring rules (score.h). */
#include "diff/score/gates.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define BAR_INTERIOR 0.1     /* R1: per cent of pixels that may exceed */
#define BAR_BAND 99.0        /* R2: per cent of the band that must agree */
#define BAR_GROSS_CODES 32   /* R3 */
#define BAR_GROSS_PIXELS 4
#define BAR_GROSS_SHARE 1e-5
#define BAR_DEPTH 0x1p-23    /* R5, plus slope / 256: llvmpipe snaps vertices to 1/256 pixel */
#define BAR_DEPTH_16 0x1p-16
#define BAR_FLIP 0.005       /* P */

const struct score_gate_info score_gates[N_GATES] = {
	[GATE_V] = { "V", "validity", 1, { { "numbers that are NaN or infinite", "", 0 } } },
	[GATE_R1] = { "R1", "interior colour", 1, { { "interior pixels over 2/255", "%", 0 } } },
	[GATE_R1B] = { "R1b", "blended pixels", 1, { { "blended pixels over 2/255 + 0.5/255 per layer", "%", 0 } } },
	[GATE_R2] = { "R2", "edge band", 1, { { "band pixels within 2/255 of a neighbour", "%", 1 } } },
	[GATE_R3] = { "R3", "gross errors", 1, { { "pixels over 32/255", "px", 0 } } },
	[GATE_R4] = { "R4", "silhouette", 2, { { "IoU of coverage", "", 1 }, { "largest unmatched blob", "px", 0 } } },
	[GATE_R5] = { "R5", "depth", 1, { { "interior pixels off in depth", "px", 0 } } },
	[GATE_E1] = { "E1", "closure", 1, { { "pixels where the channels do not add up", "px", 0 } } },
	[GATE_E2] = { "E2", "unexplained", 1, { { "pixels that differ without a reason", "px", 0 } } },
	[GATE_E3] = { "E3", "effects", 1, { { "effects outside of their range", "", 0 } } },
	[GATE_P] = { "P", "perceptual", 1, { { "FLIP mean", "", 0 } } },
	[GATE_B] = { "B", "baseline", 2, { { "pixels off from the approved frame", "%", 0 }, { "HDR-FLIP mean", "", 0 } } },
};

const char *const score_outcome_names[N_SCORE_OUTCOMES] = { "passed", "failed", "flaky", "new", "missing", "extra",
	                                                           "unreadable" };
const char *const score_state_names[N_SCORE_STATES] = { "not measured", "passed", "warned", "failed" };
const char *const score_effect_names[N_SCORE_EFFECTS] = { "shadow", "relight", "reflect", "refract", "any" };

/** 1 where a value is on the good side of a bound. */
static int is_within(int at_least, double value, double bound)
{
	return at_least ? value >= bound : value <= bound;
}

void gate_measure(const struct score_options *options, struct score *s, enum score_gate_id id, int figure, double value,
                  double bar)
{
	const int at_least = score_gates[id].figures[figure].at_least;
	struct score_gate *g = &s->gates[id];
	enum score_state state = SCORE_PASSED;
	double warn = NAN, better = NAN;

	for (size_t i = 0; i < options->n_bars; i++) {
		const struct score_bar *b = &options->bars[i];

		if (b->gate != id || b->figure != figure)
			continue;
		bar = isnan(b->bar) ? bar : b->bar;
		warn = isnan(b->warn) ? warn : b->warn;
		better = isnan(b->better) ? better : b->better;
	}
	g->value[figure] = value;
	g->bar[figure] = bar;
	if (!is_within(at_least, value, bar)) {
		state = SCORE_FAILED;
	} else if (!isnan(better) && value != better && is_within(at_least, value, better)) {
		state = SCORE_FAILED;
		g->better_than_expected = 1;
	} else if (!isnan(warn) && !is_within(at_least, value, warn)) {
		state = SCORE_WARNED;
	}
	g->state = state > g->state ? state : g->state;
}

void gate_note(struct score *s, enum score_gate_id id, const char *fmt, ...)
{
	va_list args;

	va_start(args, fmt);
	vsnprintf(s->gates[id].note, sizeof(s->gates[id].note), fmt, args);
	va_end(args);
}

/* Gates on colour. */

static void gate_color(const struct score_picture *ref, const struct score_picture *traced, const struct score_maps *maps,
                       const struct score_options *options, struct score *s)
{
	const size_t n = (size_t)ref->width * ref->height;
	uint64_t count[3] = { 0 }, failing[3] = { 0 }, gross = 0; /* interior, blended, band */

	for (size_t i = 0; i < n; i++) {
		if (gate_ignores(ref, i))
			continue;
		int kind = maps->band[i] ? 2 : gate_layers_at(traced, i) > 0 ? 1 : 0;

		count[kind]++;
		failing[kind] += maps->failing[i];
		gross += maps->residual[i] > BAR_GROSS_CODES;
		s->worst = maps->difference[i] > s->worst ? maps->difference[i] : s->worst;
	}
	s->failing_pixels = failing[0] + failing[1] + failing[2];
	s->fidelity = 1 - (double)s->failing_pixels / fmax(1, (double)(count[0] + count[1] + count[2]));

	if (count[0]) {
		gate_measure(options, s, GATE_R1, 0, 100 * (double)failing[0] / (double)count[0], BAR_INTERIOR);
		gate_note(s, GATE_R1, "%" PRIu64 " of %" PRIu64 " interior pixels", failing[0], count[0]);
	} else {
		gate_note(s, GATE_R1, "no pixel is interior");
	}
	if (count[1]) {
		gate_measure(options, s, GATE_R1B, 0, 100 * (double)failing[1] / (double)count[1], BAR_INTERIOR);
		gate_note(s, GATE_R1B, "%" PRIu64 " of %" PRIu64 " blended pixels", failing[1], count[1]);
	} else {
		gate_note(s, GATE_R1B, traced->layers ? "nothing is blended"
		                                 : "the frame has no channel \"layers\"; blended pixels count in R1");
	}
	if (count[2]) {
		gate_measure(options, s, GATE_R2, 0, 100 - 100 * (double)failing[2] / (double)count[2], BAR_BAND);
		gate_note(s, GATE_R2, "%" PRIu64 " of %" PRIu64 " band pixels fail", failing[2], count[2]);
	} else {
		gate_note(s, GATE_R2, traced->id || traced->depth ? "there are no edges"
		                                             : "neither id nor depth: all pixels count in R1");
	}
	gate_measure(options, s, GATE_R3, 0, (double)gross, fmax(BAR_GROSS_PIXELS, BAR_GROSS_SHARE * (double)n));
	gate_note(s, GATE_R3, "worst pixel %u/255", s->worst);
}

/* Depth. */

/** How much depth changes over one pixel, along x plus along y. */
static double slope_at(const float *depth, int width, int height, int x, int y)
{
	const float *z = depth + (size_t)y * (size_t)width + x;
	double sx = 0, sy = 0;

	if (x > 0)
		sx = fabs((double)z[0] - (double)z[-1]);
	if (x + 1 < width)
		sx = fmax(sx, fabs((double)z[1] - (double)z[0]));
	if (y > 0)
		sy = fabs((double)z[0] - (double)z[-width]);
	if (y + 1 < height)
		sy = fmax(sy, fabs((double)z[width] - (double)z[0]));
	return sx + sy;
}

static void gate_depth(const struct score_picture *ref, const struct score_picture *traced,
                       const struct score_maps *maps, const struct score_options *options, uint8_t *blamed, struct score *s)
{
	const size_t n = (size_t)ref->width * ref->height;
	uint64_t failing = 0, count = 0;
	double bar, worst = 0;

	if (!ref->depth || !traced->depth) {
		gate_note(s, GATE_R5, ref->depth ? "the frame has no channel \"gl.depth\"" : "no depth reference");
		return;
	}
	bar = gate_depth_is_16_bit(ref->depth, n) ? BAR_DEPTH_16 : BAR_DEPTH;
	for (int y = 0; y < (int)ref->height; y++) {
		for (int x = 0; x < (int)ref->width; x++) {
			size_t i = (size_t)y * ref->width + (size_t)x;
			double off;

			if (maps->band[i] || gate_ignores(ref, i))
				continue;
			off = fabs((double)ref->depth[i] - (double)traced->depth[i]) /
				(bar + slope_at(ref->depth, (int)ref->width, (int)ref->height, x, y) / 256);
			count++;
			failing += off > 1;
			blamed[i] |= off > 1;
			worst = fmax(worst, off);
		}
	}
	if (count == 0) {
		gate_note(s, GATE_R5, "no pixel is interior");
		return;
	}
	gate_measure(options, s, GATE_R5, 0, (double)failing, 0);
	gate_note(s, GATE_R5, "worst is %.3g of the bar (2^%d + slope/256)", worst, bar == BAR_DEPTH ? -23 : -16);
}

/* Validity. */

/** The first reason why the frame is no valid answer to the reference, in the gate's note; counts odd numbers. */
static void gate_validity(const struct score_picture *ref, const struct image *img, uint64_t frame, const char *layer,
                          const struct score_options *options, struct score *s)
{
	const size_t n = (size_t)img->width * img->height;
	const char *number = image_attribute(img, "relume:frame");
	const char *odd_channel = NULL;
	const float *planes[3];
	uint64_t odd = 0;

	for (size_t c = 0; c < img->n_channels; c++) {
		const float *values = image_values(img, c);

		for (size_t i = 0; i < n; i++) {
			if (values && isfinite(values[i]))
				continue;
			odd++;
			if (!odd_channel)
				odd_channel = img->channels[c].name;
		}
	}
	gate_measure(options, s, GATE_V, 0, (double)odd, 0);
	if (odd_channel)
		gate_note(s, GATE_V, "first in channel %s", odd_channel);

	if (img->width != ref->width || img->height != ref->height) {
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "size %u x %u, but the reference is %u x %u", img->width, img->height, ref->width, ref->height);
	} else if (!gate_find_layer(img, layer, planes)) {
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "there is no layer \"%s\"", layer);
	} else if (strcmp(layer, "gl") == 0 && !gate_find_layer(img, "beauty", planes)) {
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "a traced frame, but without channels R, G and B");
	} else if (number && strtoull(number, NULL, 10) != frame) {
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "the file says that it is frame %.20s, not %" PRIu64, number, frame);
	} else if (n == 0) {
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "the picture is empty");
	}
	for (size_t i = 0; i < options->n_channels; i++) {
		if (image_channel(img, options->channels[i]))
			continue;
		s->gates[GATE_V].state = SCORE_FAILED;
		gate_note(s, GATE_V, "there is no channel \"%.40s\"", options->channels[i]);
		break;
	}
}

/** What is ignored is equal, for all that looks at whole pictures. */
static void copy_ignored(const struct score_picture *ref, const struct score_picture *to)
{
	const size_t n = (size_t)ref->width * ref->height;

	for (size_t i = 0; ref->ignore && i < n; i++)
		if (ref->ignore[i])
			memcpy(to->rgb + 3 * i, ref->rgb + 3 * i, 3);
}

/* Figures that never decide. */

static int measure_beauty(const struct score_picture *ref, const struct image *img, struct score *s)
{
	const size_t n = (size_t)ref->width * ref->height;
	struct score_picture beauty = { 0 };
	int err = score_picture_from_image(img, "beauty", &beauty);

	if (err)
		return err == ERR_INPUT ? 0 : err; /* there is none */
	copy_ignored(ref, &beauty);
	err = flip_compare(ref->rgb, beauty.rgb, ref->width, ref->height, NULL, &s->info.beauty_flip);
	s->info.beauty_psnr_db = metric_psnr_db(ref->rgb, beauty.rgb, n);
	s->info.beauty_ms_ssim = metric_ms_ssim(ref->rgb, beauty.rgb, ref->width, ref->height);
	s->info.beauty_ciede_p95 = metric_ciede2000_p95(ref->rgb, beauty.rgb, n);
	score_picture_free(&beauty);
	return err;
}

static void clear_score(struct score *s, const struct score_picture *ref, uint64_t frame)
{
	*s = (struct score){ .frame = frame, .width = ref->width, .height = ref->height };
	s->info = (struct score_info){ NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, { NAN, NAN, NAN, NAN, NAN } };
}

/** What can be said of a valid frame without a reference. */
static int measure_against_approved(const struct score_picture *ref, const struct image *img, struct score_picture *traced,
                                    const struct score_options *options, const struct score_approved *approved,
                                    struct score *out)
{
	const size_t n = (size_t)ref->width * ref->height;
	uint8_t *blamed = calloc(n ? n : 1, 1);
	int err = blamed ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (int g = GATE_R1; g < N_GATES; g++)
		gate_note(out, (enum score_gate_id)g, "there is no reference");
	if (!err) {
		gate_effects(ref, img, options, blamed, out);
		err = gate_baseline(ref, img, approved, options, blamed, out);
	}
	if (!err)
		err = gate_blame(traced, approved, blamed, n, out);
	free(blamed);
	score_picture_free(traced);
	return err;
}

/** Everything that is measured on a valid frame. */
static int measure_frame(const struct score_picture *ref, const struct image *img, const char *layer,
                         const struct score_options *options, const struct score_approved *approved, struct score *out)
{
	const size_t n = (size_t)ref->width * ref->height;
	struct score_picture traced = { 0 };
	struct score_maps maps = { 0 };
	uint8_t *blamed = NULL;
	double flip;
	int err = score_picture_from_image(img, layer, &traced);

	if (err)
		return err;
	if (!ref->rgb)
		return measure_against_approved(ref, img, &traced, options, approved, out);
	copy_ignored(ref, &traced);
	err = score_make_maps(ref, &traced, options, &maps);
	blamed = malloc(n ? n : 1);
	if (!err && !blamed)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (err)
		goto fail;
	memcpy(blamed, maps.failing, n);
	gate_color(ref, &traced, &maps, options, out);
	err = gate_silhouette(ref, &traced, options, out);
	if (err)
		goto fail;
	gate_depth(ref, &traced, &maps, options, blamed, out);
	gate_effects(ref, img, options, blamed, out);
	err = flip_compare(ref->rgb, traced.rgb, ref->width, ref->height, NULL, &flip);
	if (err)
		goto fail;
	gate_measure(options, out, GATE_P, 0, flip, BAR_FLIP);
	err = gate_baseline(ref, img, approved, options, blamed, out);
	if (err)
		goto fail;
	out->info.gl_psnr_db = metric_psnr_db(ref->rgb, traced.rgb, n);
	out->info.gl_ssim = metric_ssim(ref->rgb, traced.rgb, ref->width, ref->height);
	out->info.gl_rmse = metric_rmse(ref->rgb, traced.rgb, n);
	out->info.gl_mrse = metric_mrse(ref->rgb, traced.rgb, n);
	if (options->yee)
		err = options->yee(ref->rgb, traced.rgb, ref->width, ref->height, &out->info.gl_yee);
	if (!err)
		err = gate_blame(&traced, approved, blamed, n, out);
	if (!err)
		err = measure_beauty(ref, img, out);
fail:
	free(blamed);
	score_maps_free(&maps);
	score_picture_free(&traced);
	return err;
}

int score_frame(const struct score_picture *ref, const struct image *img, uint64_t frame,
                const struct score_options *options, const struct score_approved *approved, struct score *out)
{
	const float *planes[3];
	const char *layer = options->channel ? options->channel : gate_find_layer(img, "gl", planes) ? "gl" : "beauty";
	int err = 0;

	clear_score(out, ref, frame);
	snprintf(out->layer, sizeof(out->layer), "%s", layer);
	gate_validity(ref, img, frame, layer, options, out);
	if (out->gates[GATE_V].state == SCORE_FAILED) {
		for (int g = GATE_V + 1; g < N_GATES; g++)
			gate_note(out, (enum score_gate_id)g, "the frame is not valid");
	} else {
		err = measure_frame(ref, img, layer, options, approved, out);
	}
	for (int g = 0; g < N_GATES; g++)
		if (out->gates[g].state == SCORE_FAILED)
			out->outcome = SCORE_FRAME_FAILED;
	return err;
}
