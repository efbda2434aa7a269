/* The gates: what each measures, its bar, and the verdict. Constants are those of the scoring rules (score.h). */
#include "diff/score.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define BAR_CODES 2          /* R1, R2: largest channel difference */
#define BAR_PER_LAYER 0.5    /* R1b: more for each blended layer */
#define BAR_INTERIOR 0.1     /* R1: per cent of pixels that may exceed */
#define BAR_BAND 99.0        /* R2: per cent of the band that must agree */
#define BAR_GROSS_CODES 32   /* R3 */
#define BAR_GROSS_PIXELS 4
#define BAR_GROSS_SHARE 1e-5
#define BAR_IOU 0.999        /* R4 */
#define BAR_BLOB 4
#define BAR_DEPTH 0x1p-23    /* R5, plus slope / 256: llvmpipe snaps vertices to 1/256 pixel */
#define BAR_DEPTH_16 0x1p-16
#define BAR_CLOSURE_HALF 0x1p-9 /* E1 */
#define BAR_CLOSURE_FLOAT 1e-5
#define BAR_FLIP 0.005       /* P */

/* A pixel is covered where it differs from the background by more than HIGH, not covered up to LOW: fog or blending
 * that fades into the background must not flip between the two by rounding. */
enum { COVER_LOW = 2, COVER_HIGH = 4 };

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
};

const char *const score_outcome_names[N_SCORE_OUTCOMES] = { "passed", "failed", "missing", "extra", "unreadable" };
const char *const score_effect_names[N_SCORE_EFFECTS] = { "shadow", "relight", "reflect", "refract", "any" };

/** Enter one figure; the gate fails where any of its figures misses its bar (NaN misses every bar). */
static void measure(struct score *s, enum score_gate_id id, int figure, double value, double bar)
{
	struct score_gate *g = &s->gates[id];
	int holds = score_gates[id].figures[figure].at_least ? value >= bar : value <= bar;

	g->value[figure] = value;
	g->bar[figure] = bar;
	if (!holds)
		g->state = SCORE_FAILED;
	else if (g->state == SCORE_NOT_MEASURED)
		g->state = SCORE_PASSED;
}

static void note(struct score *s, enum score_gate_id id, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

static void note(struct score *s, enum score_gate_id id, const char *fmt, ...)
{
	va_list args;

	va_start(args, fmt);
	vsnprintf(s->gates[id].note, sizeof(s->gates[id].note), fmt, args);
	va_end(args);
}

/* Pictures. */

uint8_t score_code_from_linear(float linear)
{
	float display = image_display_from_linear(linear);

	/* written so that NaN gives 0; lrintf rounds half to even */
	return (uint8_t)lrintf(255 * (display > 0 ? display < 1 ? display : 1 : 0));
}

static uint8_t code_from_display(float display)
{
	return (uint8_t)lrintf(255 * (display > 0 ? display < 1 ? display : 1 : 0));
}

static int is_display(const struct image *img)
{
	const char *encoding = image_attribute(img, "relume:encoding");

	return encoding && strcmp(encoding, "display") == 0;
}

/** The planes of layer.R, layer.G, layer.B ("beauty": R, G, B); 0 where one is missing. */
static int find_layer(const struct image *img, const char *layer, const float *planes[3])
{
	for (int c = 0; c < 3; c++) {
		char name[80];

		if (strcmp(layer, "beauty") == 0)
			snprintf(name, sizeof(name), "%c", "RGB"[c]);
		else
			snprintf(name, sizeof(name), "%s.%c", layer, "RGB"[c]);
		planes[c] = image_channel(img, name);
		if (!planes[c])
			return 0;
	}
	return 1;
}

int score_picture_from_image(const struct image *img, const char *layer, struct score_picture *out)
{
	const size_t n = (size_t)img->width * img->height;
	const float *planes[3];
	const int display = is_display(img);

	if (!find_layer(img, layer, planes))
		return ERR_INPUT;
	out->rgb = malloc(n ? 3 * n : 1);
	if (!out->rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", img->width, img->height);
	out->width = img->width;
	out->height = img->height;
	for (size_t i = 0; i < n; i++)
		for (int c = 0; c < 3; c++)
			out->rgb[3 * i + (size_t)c] = display ? code_from_display(planes[c][i])
			                                      : score_code_from_linear(planes[c][i]);
	out->depth = image_channel(img, "gl.depth");
	out->id = image_channel(img, "id");
	out->layers = image_channel(img, "layers");
	return 0;
}

void score_picture_free(struct score_picture *pic)
{
	free(pic->rgb);
	*pic = (struct score_picture){ 0 };
}

/* Differences and the edge band. */

static int code_difference(const uint8_t *a, const uint8_t *b)
{
	int worst = 0;

	for (int c = 0; c < 3; c++) {
		int d = abs(a[c] - b[c]);

		worst = d > worst ? d : worst;
	}
	return worst;
}

/** The smallest difference of one pixel of `a` to the 3x3 pixels around the same place in `b`. */
static int nearest_difference(const uint8_t *a, const uint8_t *b, int width, int height, int x, int y)
{
	const uint8_t *at = a + 3 * ((size_t)y * (size_t)width + (size_t)x);
	int best = 255;

	for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
		for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
			int d = code_difference(at, b + 3 * ((size_t)v * (size_t)width + (size_t)u));

			best = d < best ? d : best;
		}
	}
	return best;
}

/** 1 where the reference's depths are all steps of a 16-bit depth buffer. */
static int depth_is_16_bit(const float *depth, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		double steps = (double)depth[i] * 65535;

		if (fabs(steps - rint(steps)) > 1e-2)
			return 0;
	}
	return 1;
}

/** Does depth bend at the middle of three samples in a row? See "edges" in score.h. */
static int depth_bends(double before, double at, double after, double epsilon)
{
	double rise = fmax(fabs(after - at), fabs(at - before));

	return !(fabs(before - 2 * at + after) <= epsilon + rise / 8); /* NaN bends */
}

static void mark_depth_edges(const float *depth, int width, int height, double epsilon, uint8_t *band)
{
	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			const float *z = depth + (size_t)y * (size_t)width + x;

			if ((x > 0 && x + 1 < width && depth_bends((double)z[-1], (double)z[0], (double)z[1], epsilon)) ||
			    (y > 0 && y + 1 < height &&
			     depth_bends((double)z[-width], (double)z[0], (double)z[width], epsilon)))
				band[z - depth] = 1;
		}
	}
}

static void mark_id_edges(const float *id, int width, int height, uint8_t *band)
{
	for (int y = 0; y < height; y++)
		for (int x = 0; x < width; x++)
			for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++)
				for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++)
					if (id[v * (ptrdiff_t)width + u] != id[y * (ptrdiff_t)width + x])
						band[y * (ptrdiff_t)width + x] = 1;
}

static float layers_at(const struct score_picture *traced, size_t i)
{
	return traced->layers && traced->layers[i] > 0 ? traced->layers[i] : 0;
}

int score_make_maps(const struct score_picture *ref, const struct score_picture *traced, struct score_maps *out)
{
	const size_t n = (size_t)ref->width * ref->height;
	const int width = (int)ref->width, height = (int)ref->height;
	uint8_t *memory = calloc(n ? n : 1, 4);

	if (!memory)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %d x %d pixels", width, height);
	*out = (struct score_maps){ memory, memory + n, memory + 2 * n, memory + 3 * n };

	if (traced->id)
		mark_id_edges(traced->id, width, height, out->band);
	if (traced->depth)
		mark_depth_edges(traced->depth, width, height, SCORE_DEPTH_EPSILON, out->band);
	if (ref->depth)
		mark_depth_edges(ref->depth, width, height,
		                 depth_is_16_bit(ref->depth, n) ? SCORE_DEPTH_EPSILON_16 : SCORE_DEPTH_EPSILON,
		                 out->band);

	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			size_t i = (size_t)y * (size_t)width + (size_t)x;
			int plain = code_difference(ref->rgb + 3 * i, traced->rgb + 3 * i), residual = plain;

			if (plain > BAR_CODES) {
				int there = nearest_difference(traced->rgb, ref->rgb, width, height, x, y);
				int back = nearest_difference(ref->rgb, traced->rgb, width, height, x, y);

				residual = there > back ? there : back;
			}
			out->difference[i] = (uint8_t)plain;
			out->residual[i] = (uint8_t)residual;
			out->failing[i] = out->band[i] ? residual > BAR_CODES
				: plain > BAR_CODES + BAR_PER_LAYER * (double)layers_at(traced, i);
		}
	}
	return 0;
}

void score_maps_free(struct score_maps *maps)
{
	free(maps->difference); /* the first of one block */
	*maps = (struct score_maps){ 0 };
}

/* Gates on colour. */

static void gate_color(const struct score_picture *traced, const struct score_maps *maps, size_t n, struct score *s)
{
	uint64_t count[3] = { 0 }, failing[3] = { 0 }, gross = 0; /* interior, blended, band */

	for (size_t i = 0; i < n; i++) {
		int kind = maps->band[i] ? 2 : layers_at(traced, i) > 0 ? 1 : 0;

		count[kind]++;
		failing[kind] += maps->failing[i];
		gross += maps->residual[i] > BAR_GROSS_CODES;
		s->worst = maps->difference[i] > s->worst ? maps->difference[i] : s->worst;
	}
	s->failing_pixels = failing[0] + failing[1] + failing[2];
	s->fidelity = 1 - (double)s->failing_pixels / (double)n;

	if (count[0]) {
		measure(s, GATE_R1, 0, 100 * (double)failing[0] / (double)count[0], BAR_INTERIOR);
		note(s, GATE_R1, "%" PRIu64 " of %" PRIu64 " interior pixels", failing[0], count[0]);
	} else {
		note(s, GATE_R1, "no pixel is interior");
	}
	if (count[1]) {
		measure(s, GATE_R1B, 0, 100 * (double)failing[1] / (double)count[1], BAR_INTERIOR);
		note(s, GATE_R1B, "%" PRIu64 " of %" PRIu64 " blended pixels", failing[1], count[1]);
	} else {
		note(s, GATE_R1B, traced->layers ? "nothing is blended"
		                                 : "the frame has no channel \"layers\"; blended pixels count in R1");
	}
	if (count[2]) {
		measure(s, GATE_R2, 0, 100 - 100 * (double)failing[2] / (double)count[2], BAR_BAND);
		note(s, GATE_R2, "%" PRIu64 " of %" PRIu64 " band pixels fail", failing[2], count[2]);
	} else {
		note(s, GATE_R2, traced->id || traced->depth ? "there are no edges"
		                                             : "neither id nor depth: all pixels count in R1");
	}
	measure(s, GATE_R3, 0, (double)gross, fmax(BAR_GROSS_PIXELS, BAR_GROSS_SHARE * (double)n));
	note(s, GATE_R3, "worst pixel %u/255", s->worst);
}

/* Silhouettes. */

/** The most frequent colour among pixels of `chosen` (NULL: all), packed; 0 where there is no such pixel. */
static int find_background(const uint8_t *rgb, const uint8_t *chosen, size_t n, uint8_t color[3], int *found)
{
	uint32_t *counts = calloc(1 << 24, sizeof(*counts)), most = 0;

	if (!counts)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n; i++) {
		const uint8_t *p = rgb + 3 * i;
		uint32_t *count = &counts[p[0] << 16 | p[1] << 8 | p[2]];

		if (chosen && !chosen[i])
			continue;
		if (++*count > most) {
			most = *count;
			memcpy(color, p, 3);
		}
	}
	free(counts);
	*found = most > 0;
	return 0;
}

/** Size of the largest group of marked pixels that touch, corners included. Clears the marks. */
static int largest_blob(uint8_t *marks, int width, int height, uint64_t *largest)
{
	const size_t n = (size_t)width * (size_t)height;
	uint32_t *stack = malloc((n ? n : 1) * sizeof(*stack));

	if (!stack)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	*largest = 0;
	for (size_t start = 0; start < n; start++) {
		size_t top = 0;
		uint64_t size = 0;

		if (!marks[start])
			continue;
		marks[start] = 0;
		stack[top++] = (uint32_t)start;
		while (top) {
			int x = (int)(stack[--top] % (uint32_t)width), y = (int)(stack[top] / (uint32_t)width);

			size++;
			for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
				for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
					size_t i = (size_t)v * (size_t)width + (size_t)u;

					if (marks[i]) {
						marks[i] = 0; /* each pixel is pushed once: the stack holds n */
						stack[top++] = (uint32_t)i;
					}
				}
			}
		}
		*largest = size > *largest ? size : *largest;
	}
	free(stack);
	return 0;
}

/** Depth of the background: what the traced frame holds where nothing was drawn; GL's default where all is covered. */
static float background_depth(const struct score_picture *traced, size_t n)
{
	for (size_t i = 0; traced->id && i < n; i++)
		if (traced->id[i] == 0)
			return traced->depth[i];
	return 1;
}

/* How surely a pixel shows more than the background: 0 not, 1 maybe, 2 surely. */
static int coverage(const struct score_picture *pic, size_t i, int use_depth, float far_depth, const uint8_t *background)
{
	int d = background ? code_difference(pic->rgb + 3 * i, background) : 0;

	if (use_depth && pic->depth[i] != far_depth)
		return 2;
	return d > COVER_HIGH ? 2 : d > COVER_LOW ? 1 : 0;
}

static int gate_silhouette(const struct score_picture *ref, const struct score_picture *traced, size_t n,
                           struct score *s)
{
	const int use_depth = ref->depth && traced->depth;
	const float far_depth = use_depth ? background_depth(traced, n) : 1;
	uint8_t *marks = calloc(n ? n : 1, 1);
	uint8_t background[2][3];
	uint64_t both = 0, unmatched = 0, largest = 0;
	int found[2], err = ERR_SYSTEM;

	if (!marks) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		goto fail;
	}
	/* The background's colour, on each side, where the traced frame drew nothing. */
	for (size_t i = 0; i < n; i++)
		marks[i] = traced->id ? traced->id[i] == 0 : use_depth ? traced->depth[i] == far_depth : 1;
	err = find_background(ref->rgb, marks, n, background[0], &found[0]);
	if (!err)
		err = find_background(traced->rgb, marks, n, background[1], &found[1]);
	if (err)
		goto fail;
	if (!use_depth && !found[0]) {
		note(s, GATE_R4, "depth is not on both sides, and every pixel is covered");
		goto fail;
	}

	for (size_t i = 0; i < n; i++) {
		int a = coverage(ref, i, use_depth, far_depth, found[0] ? background[0] : NULL);
		int b = coverage(traced, i, use_depth, far_depth, found[1] ? background[1] : NULL);

		marks[i] = (a == 2 && b == 0) || (a == 0 && b == 2);
		unmatched += marks[i];
		both += a && b;
	}
	err = largest_blob(marks, (int)ref->width, (int)ref->height, &largest);
	if (err)
		goto fail;
	measure(s, GATE_R4, 0, both + unmatched ? (double)both / (double)(both + unmatched) : 1, BAR_IOU);
	measure(s, GATE_R4, 1, (double)largest, BAR_BLOB);
	note(s, GATE_R4, "%s; %" PRIu64 " px covered, %" PRIu64 " unmatched",
	     use_depth ? "from depth and colour"
	               : ref->depth ? "no gl.depth in the frame: from difference to the background colour"
	                            : "no depth reference: from difference to the background colour",
	     both + unmatched, unmatched);
fail:
	free(marks);
	return err;
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
                       const struct score_maps *maps, size_t n, struct score *s)
{
	uint64_t failing = 0, count = 0;
	double bar, worst = 0;

	if (!ref->depth || !traced->depth) {
		note(s, GATE_R5, ref->depth ? "the frame has no channel \"gl.depth\"" : "no depth reference");
		return;
	}
	bar = depth_is_16_bit(ref->depth, n) ? BAR_DEPTH_16 : BAR_DEPTH;
	for (int y = 0; y < (int)ref->height; y++) {
		for (int x = 0; x < (int)ref->width; x++) {
			size_t i = (size_t)y * ref->width + (size_t)x;
			double off;

			if (maps->band[i])
				continue;
			off = fabs((double)ref->depth[i] - (double)traced->depth[i]) /
				(bar + slope_at(ref->depth, (int)ref->width, (int)ref->height, x, y) / 256);
			count++;
			failing += off > 1;
			worst = fmax(worst, off);
		}
	}
	if (count == 0) {
		note(s, GATE_R5, "no pixel is interior");
		return;
	}
	measure(s, GATE_R5, 0, (double)failing, 0);
	note(s, GATE_R5, "worst is %.3g of the bar (2^%d + slope/256)", worst, bar == BAR_DEPTH ? -23 : -16);
}

/* Effects. */

static const struct image_channel *find_channel(const struct image *img, const char *layer, int c)
{
	char name[80];

	snprintf(name, sizeof(name), layer[0] ? "%s.%c" : "%s%c", layer, "RGB"[c]);
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return &img->channels[i];
	return NULL;
}

/** The stored value of an effect channel, or what its absence means. */
static double effect_at(const struct image_channel *channel, size_t i, double absent)
{
	return channel ? (double)channel->values[i] : absent;
}

/* The six layers of one colour: beauty, gl, shadow, relight, reflect, refract. */
enum { LAYER_BEAUTY, LAYER_GL, LAYER_SHADOW, LAYER_RELIGHT, LAYER_REFLECT, LAYER_REFRACT, N_LAYERS };

static void gate_effects(const struct image *img, const struct score_options *options, struct score *s)
{
	static const char *const names[N_LAYERS] = { "", "gl", "shadow", "relight", "reflect", "refract" };
	const struct image_channel *ch[3][N_LAYERS];
	const size_t n = (size_t)img->width * img->height;
	uint64_t open = 0, unexplained = 0, touched[N_SCORE_EFFECTS] = { 0 };
	double relative = BAR_CLOSURE_FLOAT, absolute = 1e-12, worst = 0;
	int any_effect = 0;

	for (int c = 0; c < 3; c++) {
		for (int l = 0; l < N_LAYERS; l++) {
			ch[c][l] = find_channel(img, names[l], c);
			any_effect |= l >= LAYER_SHADOW && ch[c][l];
			if (ch[c][l] && !ch[c][l]->full_float) {
				relative = BAR_CLOSURE_HALF;
				absolute = 0x1p-23; /* four times half a step of halfs below 2^-14 */
			}
		}
		if (!ch[c][LAYER_BEAUTY] || !ch[c][LAYER_GL]) {
			for (int g = GATE_E1; g <= GATE_E3; g++)
				note(s, (enum score_gate_id)g, "the frame has no channels R and gl.R");
			return;
		}
	}

	for (size_t i = 0; i < n; i++) {
		int is_open = 0, differs = 0, effect[N_SCORE_EFFECTS] = { 0 };

		for (int c = 0; c < 3; c++) {
			double beauty = effect_at(ch[c][LAYER_BEAUTY], i, 0), gl = effect_at(ch[c][LAYER_GL], i, 0);
			double shadow = effect_at(ch[c][LAYER_SHADOW], i, 1);
			double more[3] = { effect_at(ch[c][LAYER_RELIGHT], i, 0), effect_at(ch[c][LAYER_REFLECT], i, 0),
			                   effect_at(ch[c][LAYER_REFRACT], i, 0) };
			double sum = gl * shadow + more[0] + more[1] + more[2];
			double size = fabs(gl * shadow) + fabs(more[0]) + fabs(more[1]) + fabs(more[2]);
			double bar = relative * fmax(size, fabs(beauty)) + absolute;

			is_open |= !(fabs(beauty - sum) <= bar);
			worst = fmax(worst, fabs(beauty - sum) / bar);
			differs |= !(fabs(beauty - gl) <= relative * fmax(fabs(gl), fabs(beauty)) + absolute);
			effect[EFFECT_SHADOW] |= shadow != 1;
			for (int k = 0; k < 3; k++)
				effect[EFFECT_RELIGHT + k] |= more[k] != 0;
		}
		for (int k = 0; k < EFFECT_ANY; k++)
			effect[EFFECT_ANY] |= effect[k];
		for (int k = 0; k < N_SCORE_EFFECTS; k++)
			touched[k] += (uint64_t)effect[k];
		open += (uint64_t)is_open;
		unexplained += differs && !effect[EFFECT_ANY];
	}
	for (int k = 0; k < N_SCORE_EFFECTS; k++)
		s->info.effect_share[k] = (double)touched[k] / (double)n;

	measure(s, GATE_E1, 0, (double)open, 0);
	note(s, GATE_E1, "worst is %.3g of the bar (relative %s)%s", worst, relative == BAR_CLOSURE_HALF ? "2^-9" : "1e-5",
	     any_effect ? "" : "; no effect channels: beauty must equal gl");
	measure(s, GATE_E2, 0, (double)unexplained, 0);

	int outside = 0;

	for (size_t k = 0; k < options->n_ranges; k++) {
		const struct score_range *r = &options->ranges[k];
		double share = s->info.effect_share[r->effect];
		/* an unset bound is NAN, and nothing lies beyond it */
		if (share < r->low || share > r->high) {
			outside++;
			note(s, GATE_E3, "%s touches %.3f %% of the pixels", score_effect_names[r->effect], 100 * share);
		}
	}
	if (options->n_ranges)
		measure(s, GATE_E3, 0, outside, 0);
	else
		note(s, GATE_E3, "no range asked for");
}

/* Validity. */

/** The first reason why the frame is no valid answer to the reference, in the gate's note; counts odd numbers. */
static void gate_validity(const struct score_picture *ref, const struct image *img, uint64_t frame, const char *layer,
                          struct score *s)
{
	const size_t n = (size_t)img->width * img->height;
	const char *number = image_attribute(img, "relume:frame");
	const char *odd_channel = NULL;
	const float *planes[3];
	uint64_t odd = 0;

	for (size_t c = 0; c < img->n_channels; c++) {
		for (size_t i = 0; i < n; i++) {
			if (isfinite(img->channels[c].values[i]))
				continue;
			odd++;
			if (!odd_channel)
				odd_channel = img->channels[c].name;
		}
	}
	measure(s, GATE_V, 0, (double)odd, 0);
	if (odd_channel)
		note(s, GATE_V, "NaN or infinite numbers, first in channel %s", odd_channel);

	if (img->width != ref->width || img->height != ref->height) {
		s->gates[GATE_V].state = SCORE_FAILED;
		note(s, GATE_V, "size %u x %u, but the reference is %u x %u", img->width, img->height, ref->width, ref->height);
	} else if (!find_layer(img, layer, planes)) {
		s->gates[GATE_V].state = SCORE_FAILED;
		note(s, GATE_V, "there is no layer \"%s\"", layer);
	} else if (strcmp(layer, "gl") == 0 && !find_layer(img, "beauty", planes)) {
		s->gates[GATE_V].state = SCORE_FAILED;
		note(s, GATE_V, "a traced frame, but without channels R, G and B");
	} else if (number && strtoull(number, NULL, 10) != frame) {
		s->gates[GATE_V].state = SCORE_FAILED;
		note(s, GATE_V, "the file says that it is frame %.20s, not %" PRIu64, number, frame);
	} else if (n == 0) {
		s->gates[GATE_V].state = SCORE_FAILED;
		note(s, GATE_V, "the picture is empty");
	}
}

/* Blame. */

static int compare_ids(const void *a, const void *b)
{
	uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;

	return (x > y) - (x < y);
}

/** Keep the draws with most failing pixels, in falling order. */
static void add_blame(struct score *s, uint32_t draw, uint64_t pixels)
{
	uint32_t at = s->n_blame;

	if (at == SCORE_MAX_BLAME) {
		if (s->blame[at - 1].pixels >= pixels)
			return;
		at--;
	} else {
		s->n_blame++;
	}
	for (; at > 0 && s->blame[at - 1].pixels < pixels; at--)
		s->blame[at] = s->blame[at - 1];
	s->blame[at] = (struct score_blame){ .draw = draw, .pixels = pixels };
}

static int blame_draws(const struct score_picture *traced, const struct score_maps *maps, size_t n, struct score *s)
{
	uint32_t *ids;
	size_t count = 0;

	if (!traced->id || s->failing_pixels == 0)
		return 0;
	ids = malloc(s->failing_pixels * sizeof(*ids));
	if (!ids)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n; i++) {
		float id = traced->id[i];

		if (maps->failing[i])
			ids[count++] = id > 0 && id < 4294967040.0f ? (uint32_t)id : 0;
	}
	qsort(ids, count, sizeof(*ids), compare_ids);
	for (size_t i = 0, end; i < count; i = end) {
		for (end = i + 1; end < count && ids[end] == ids[i]; end++)
			;
		add_blame(s, ids[i], end - i);
	}
	free(ids);
	return 0;
}

/* Figures that never decide. */

static int measure_beauty(const struct score_picture *ref, const struct image *img, struct score *s)
{
	const size_t n = (size_t)ref->width * ref->height;
	struct score_picture beauty = { 0 };
	int err = score_picture_from_image(img, "beauty", &beauty);

	if (err)
		return err == ERR_INPUT ? 0 : err; /* there is none */
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
	s->info = (struct score_info){ NAN, NAN, NAN, NAN, NAN, NAN, { NAN, NAN, NAN, NAN, NAN } };
}

int score_frame(const struct score_picture *ref, const struct image *img, uint64_t frame,
                const struct score_options *options, struct score *out)
{
	const size_t n = (size_t)ref->width * ref->height;
	const float *planes[3];
	const char *layer = options->channel ? options->channel : find_layer(img, "gl", planes) ? "gl" : "beauty";
	struct score_picture traced = { 0 };
	struct score_maps maps = { 0 };
	double flip;
	int err = 0;

	clear_score(out, ref, frame);
	snprintf(out->layer, sizeof(out->layer), "%s", layer);
	gate_validity(ref, img, frame, layer, out);
	if (out->gates[GATE_V].state != SCORE_PASSED) {
		for (int g = GATE_V + 1; g < N_GATES; g++)
			note(out, (enum score_gate_id)g, "the frame is not valid");
		out->outcome = SCORE_FRAME_FAILED;
		return 0;
	}
	err = score_picture_from_image(img, layer, &traced);
	if (!err)
		err = score_make_maps(ref, &traced, &maps);
	if (err)
		goto fail;
	gate_color(&traced, &maps, n, out);
	err = gate_silhouette(ref, &traced, n, out);
	if (err)
		goto fail;
	gate_depth(ref, &traced, &maps, n, out);
	gate_effects(img, options, out);
	err = flip_compare(ref->rgb, traced.rgb, ref->width, ref->height, NULL, &flip);
	if (err)
		goto fail;
	measure(out, GATE_P, 0, flip, BAR_FLIP);
	out->info.gl_psnr_db = metric_psnr_db(ref->rgb, traced.rgb, n);
	out->info.gl_ssim = metric_ssim(ref->rgb, traced.rgb, ref->width, ref->height);
	err = blame_draws(&traced, &maps, n, out);
	if (!err)
		err = measure_beauty(ref, img, out);
	for (int g = 0; g < N_GATES; g++)
		if (out->gates[g].state == SCORE_FAILED)
			out->outcome = SCORE_FRAME_FAILED;
fail:
	score_maps_free(&maps);
	score_picture_free(&traced);
	return err;
}
