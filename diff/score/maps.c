/* Frames as codes, and the maps that the gates on colour count: differences, edges, what fails. */
#include "diff/score/gates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define BAR_PER_LAYER 0.5    /* R1b: more for each blended layer */

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
int gate_find_layer(const struct image *img, const char *layer, const float *planes[3])
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

	if (!gate_find_layer(img, layer, planes))
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

/** The smallest difference of one pixel of `a` to the 3x3 pixels around the same place in `b`. */
static int nearest_difference(const uint8_t *a, const uint8_t *b, int width, int height, int x, int y)
{
	const uint8_t *at = a + 3 * ((size_t)y * (size_t)width + (size_t)x);
	int best = 255;

	for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
		for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
			int d = gate_code_difference(at, b + 3 * ((size_t)v * (size_t)width + (size_t)u));

			best = d < best ? d : best;
		}
	}
	return best;
}

/** 1 where the reference's depths are all steps of a 16-bit depth buffer. */
int gate_depth_is_16_bit(const float *depth, size_t n)
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

float gate_layers_at(const struct score_picture *traced, size_t i)
{
	return traced->layers && traced->layers[i] > 0 ? traced->layers[i] : 0;
}

int score_make_maps(const struct score_picture *ref, const struct score_picture *traced,
                    const struct score_options *options, struct score_maps *out)
{
	const double codes = options->codes > 0 ? options->codes : SCORE_CODES;
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
		                 gate_depth_is_16_bit(ref->depth, n) ? SCORE_DEPTH_EPSILON_16 : SCORE_DEPTH_EPSILON,
		                 out->band);

	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			size_t i = (size_t)y * (size_t)width + (size_t)x;

			if (gate_ignores(ref, i)) {
				out->band[i] = 0;
				continue;
			}
			int plain = gate_code_difference(ref->rgb + 3 * i, traced->rgb + 3 * i), residual = plain;

			if (plain > codes) {
				int there = nearest_difference(traced->rgb, ref->rgb, width, height, x, y);
				int back = nearest_difference(ref->rgb, traced->rgb, width, height, x, y);

				residual = there > back ? there : back;
			}
			out->difference[i] = (uint8_t)plain;
			out->residual[i] = (uint8_t)residual;
			out->failing[i] = out->band[i] ? residual > codes
				: plain > codes + BAR_PER_LAYER * (double)gate_layers_at(traced, i);
		}
	}
	return 0;
}

void score_maps_free(struct score_maps *maps)
{
	free(maps->difference); /* the first of one block */
	*maps = (struct score_maps){ 0 };
}
