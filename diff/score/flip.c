/*
 * FLIP, following the paper: filter both pictures as the eye does, compare colours by HyAB, compare edges and points,
 * and let features amplify colour. Section numbers refer to Andersson et al. 2020.
 */
#include "diff/score/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/picture.h"

/* Pictures are compared in bands of rows, so that all planes of a band stay in the cache. Filters reach HALO rows
 * further. */
enum { MAX_RADIUS = 16, HALO = MAX_RADIUS, BAND = 128 };

/* Weights of one axis; index radius is the centre. */
struct kernel {
	int radius;
	float w[2 * MAX_RADIUS + 1];
};

/* Three planes of one picture, and scratch of the same size. */
struct planes {
	float *p[3];
};

/* Linear Rec.709 to XYZ with white point (0.3127, 0.3290), IEC 61966-2-1 before rounding. */
static const float XYZ_FROM_RGB[3][3] = {
	{ 10135552.0f / 24577794, 8788810.0f / 24577794, 4435075.0f / 24577794 },
	{ 2613072.0f / 12288897, 8788810.0f / 12288897, 887015.0f / 12288897 },
	{ 1425312.0f / 73733382.0f, 8788810.0f / 73733382.0f, 70074185.0f / 73733382.0f },
};
static const float RGB_FROM_XYZ[3][3] = {
	{ 3.241003275f, -1.537398934f, -0.498615861f },
	{ -0.969224334f, 1.875930071f, 0.041554224f },
	{ 0.055639423f, -0.204011202f, 1.057148933f },
};
static const float WHITE[3] = { 0.950428545f, 1.0f, 1.088900371f };

static void multiply(const float m[3][3], const float v[3], float out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

/* Cube root of a normal positive number: starts at a third of its exponent, and refines by two steps of Halley's
 * method, each cubing the error. */
static float cube_root(float t)
{
	uint32_t bits;
	float root;

	memcpy(&bits, &t, sizeof(bits));
	bits = bits / 3 + 0x2a514067;
	memcpy(&root, &bits, sizeof(root));
	for (int i = 0; i < 2; i++) {
		const float cube = root * root * root;

		root *= (cube + 2 * t) / (2 * cube + t);
	}
	return root;
}

static float cube_root_of_lab(float t)
{
	const float delta = 6.0f / 29;

	return t > delta * delta * delta ? cube_root(t) : t / (3 * delta * delta) + 4.0f / 29;
}

/* L*a*b* with a and b scaled by lightness: the Hunt effect (sec. 4.1.2). */
static void hunt_lab(const float rgb[3], float lab[3])
{
	float xyz[3], f[3];

	multiply(XYZ_FROM_RGB, rgb, xyz);
	for (int i = 0; i < 3; i++)
		f[i] = cube_root_of_lab(xyz[i] / WHITE[i]);
	lab[0] = 116 * f[1] - 16;
	lab[1] = 0.01f * lab[0] * 500 * (f[0] - f[1]);
	lab[2] = 0.01f * lab[0] * 200 * (f[1] - f[2]);
}

static float length(float x, float y)
{
	return sqrtf(x * x + y * y);
}

static float hyab(const float a[3], const float b[3])
{
	return fabsf(a[0] - b[0]) + length(a[1] - b[1], a[2] - b[2]);
}

static void make_gaussian(struct kernel *k, int radius, double falloff)
{
	k->radius = radius;
	for (int i = -radius; i <= radius; i++)
		k->w[i + radius] = (float)exp(-falloff * i * i);
}

static void normalise(struct kernel *k)
{
	double sum = 0;

	for (int i = 0; i <= 2 * k->radius; i++)
		sum += k->w[i];
	for (int i = 0; i <= 2 * k->radius; i++)
		k->w[i] = (float)(k->w[i] / sum);
}

/* Scale positive weights to a sum of 1 and negative ones to -1 (sec. 4.2.1). */
static void normalise_signs(struct kernel *k)
{
	double sum[2] = { 0, 0 };

	for (int i = 0; i <= 2 * k->radius; i++)
		sum[k->w[i] < 0] += fabsf(k->w[i]);
	for (int i = 0; i <= 2 * k->radius; i++)
		k->w[i] = (float)(k->w[i] / sum[k->w[i] < 0]);
}

static int clamp(int v, int end)
{
	return v < 0 ? 0 : v >= end ? end - 1 : v;
}

/* Compiled twice: the version for vectors of eight floats is chosen if the processor has them; the sums are the same.
 * Sanitizers do not support such functions. */
#if defined(__x86_64__) && defined(__has_attribute) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __has_attribute(target_clones)
#define WIDER __attribute__((target_clones("avx2", "default")))
#endif
#endif
#ifndef WIDER
#define WIDER
#endif

/*
 * Filters along x and y. Both add the taps one by one to LANES neighbouring pixels at once, which compilers vectorize
 * without having to reorder sums; a padded row keeps the edges out of the inner loop.
 */
enum { LANES = 16 };

WIDER static void filter_x(const float *in, float *out, int width, int height, const struct kernel *k, float *padded)
{
	for (int y = 0; y < height; y++) {
		const float *row = in + (size_t)y * (size_t)width;
		float *to = out + (size_t)y * (size_t)width;

		for (int i = 0; i < width + 2 * k->radius + LANES; i++)
			padded[i] = row[clamp(i - k->radius, width)];
		for (int x = 0; x < width; x += LANES) {
			float sum[LANES] = { 0 };

			for (int i = 0; i <= 2 * k->radius; i++)
				for (int l = 0; l < LANES; l++)
					sum[l] += k->w[i] * padded[x + i + l];
			for (int l = 0; l < LANES && x + l < width; l++)
				to[x + l] = sum[l];
		}
	}
}

WIDER static void filter_y(const float *in, float *out, int width, int height, const struct kernel *k)
{
	for (int y = 0; y < height; y++) {
		const float *rows[2 * MAX_RADIUS + 1];
		float *to = out + (size_t)y * (size_t)width;
		int x = 0;

		for (int i = 0; i <= 2 * k->radius; i++)
			rows[i] = in + (size_t)clamp(y + i - k->radius, height) * (size_t)width;
		for (; x + LANES <= width; x += LANES) {
			float sum[LANES] = { 0 };

			for (int i = 0; i <= 2 * k->radius; i++)
				for (int l = 0; l < LANES; l++)
					sum[l] += k->w[i] * rows[i][x + l];
			memcpy(to + x, sum, sizeof(sum));
		}
		for (; x < width; x++) {
			float sum = 0;

			for (int i = 0; i <= 2 * k->radius; i++)
				sum += k->w[i] * rows[i][x];
			to[x] = sum;
		}
	}
}

/* Convert to YCxCz, a linear form of L*a*b* (sec. 4.1). Y of the paper's features is (plane 0 + 16) / 116. */
static void put_ycxcz(const float linear[3], const struct planes *out, size_t i)
{
	float xyz[3];

	multiply(XYZ_FROM_RGB, linear, xyz);
	for (int c = 0; c < 3; c++)
		xyz[c] /= WHITE[c];
	out->p[0][i] = 116 * xyz[1] - 16;
	out->p[1][i] = 500 * (xyz[0] - xyz[1]);
	out->p[2][i] = 200 * (xyz[1] - xyz[2]);
}

static void fill_from_codes(const uint8_t *rgb, const struct planes *out, size_t n_pixels)
{
	float linear[256];

	for (int i = 0; i < 256; i++)
		linear[i] = image_linear_from_display((float)i / 255);
	for (size_t i = 0; i < n_pixels; i++)
		put_ycxcz((const float[]){ linear[rgb[3 * i]], linear[rgb[3 * i + 1]], linear[rgb[3 * i + 2]] }, out, i);
}

/* A rational fit of the ACES film curve (Narkowicz 2015, scaled by 0.6), as in HDR-FLIP; linear in and out. */
static float film_curve(float x)
{
	float y;

	x = x > 0 ? x : 0; /* NaN is 0 */
	x = x < 1e9f ? x : 1e9f;
	y = (0.36f * 2.51f * x * x + 0.6f * 0.03f * x) / (0.36f * 2.43f * x * x + 0.6f * 0.59f * x + 0.14f);
	return y < 1 ? y : 1;
}

static void fill_from_linear(const float *const rgb[3], float exposure, const struct planes *out, size_t n_pixels)
{
	const float gain = exp2f(exposure);

	for (size_t i = 0; i < n_pixels; i++)
		put_ycxcz((const float[]){ film_curve(gain * rgb[0][i]), film_curve(gain * rgb[1][i]),
		                           film_curve(gain * rgb[2][i]) }, out, i);
}

/*
 * Contrast sensitivity (sec. 4.1.1): g(x) = a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees, in two dimensions. Each
 * term is separable; a sum of two (Cz) is filtered term by term, weighted by their shares of the two-dimensional sum.
 */
static void filter_contrast(const struct planes *pic, int width, int height, float *scratch, float *term,
                            float *padded)
{
	static const struct { double a, b; } terms[3][2] = {
		{ { 1, 0.0047 }, { 0, 1 } }, { { 1, 0.0053 }, { 0, 1 } }, { { 34.1, 0.04 }, { 13.5, 0.025 } },
	};
	const double pi = 3.14159265358979323846;
	const int radius = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * FLIP_PIXELS_PER_DEGREE);
	const size_t n = (size_t)width * (size_t)height;

	for (int c = 0; c < 3; c++) {
		struct kernel k[2];
		double weight[2] = { 0, 0 };
		int n_terms = terms[c][1].a > 0 ? 2 : 1;

		for (int t = 0; t < n_terms; t++) {
			double sum = 0;

			make_gaussian(&k[t], radius, pi * pi / terms[c][t].b /
			              ((double)FLIP_PIXELS_PER_DEGREE * FLIP_PIXELS_PER_DEGREE));
			for (int i = 0; i <= 2 * radius; i++)
				sum += k[t].w[i];
			weight[t] = terms[c][t].a * sqrt(pi / terms[c][t].b) * sum * sum;
			normalise(&k[t]);
		}
		filter_x(pic->p[c], scratch, width, height, &k[0], padded);
		if (n_terms == 1) {
			filter_y(scratch, pic->p[c], width, height, &k[0]);
			continue;
		}
		float share = (float)(weight[1] / (weight[0] + weight[1]));

		filter_y(scratch, term, width, height, &k[0]);
		filter_x(pic->p[c], scratch, width, height, &k[1], padded);
		filter_y(scratch, pic->p[c], width, height, &k[1]);
		for (size_t i = 0; i < n; i++)
			pic->p[c][i] = (1 - share) * term[i] + share * pic->p[c][i];
	}
}

/* Convert filtered YCxCz to Hunt-adjusted L*a*b*, via linear RGB clamped to [0,1]; in place. */
static void lab_from_ycxcz(const struct planes *pic, size_t n_pixels)
{
	for (size_t i = 0; i < n_pixels; i++) {
		float y = (pic->p[0][i] + 16) / 116;
		float xyz[3] = { (y + pic->p[1][i] / 500) * WHITE[0], y * WHITE[1], (y - pic->p[2][i] / 200) * WHITE[2] };
		float rgb[3], lab[3];

		multiply(RGB_FROM_XYZ, xyz, rgb);
		for (int c = 0; c < 3; c++)
			rgb[c] = rgb[c] < 0 ? 0 : rgb[c] > 1 ? 1 : rgb[c];
		hunt_lab(rgb, lab);
		for (int c = 0; c < 3; c++)
			pic->p[c][i] = lab[c];
	}
}

/* HyAB to the power 0.7, stretched so that small differences use most of [0,1] (sec. 4.1.3). */
static float color_error(const float a[3], const float b[3], float max_error)
{
	const float knee = 0.4f * max_error, at_knee = 0.95f;
	float e = powf(hyab(a, b), 0.7f);

	return e < knee ? at_knee / knee * e : at_knee + (e - knee) / (max_error - knee) * (1 - at_knee);
}

static float largest_color_error(void)
{
	const float green[3] = { 0, 1, 0 }, blue[3] = { 0, 0, 1 };
	float a[3], b[3];

	hunt_lab(green, a);
	hunt_lab(blue, b);
	return powf(hyab(a, b), 0.7f);
}

/* Rows of both pictures that are compared at once. */
struct band {
	int top, height;   /* rows of the picture that the planes hold */
	int first, n_rows; /* rows among these to compute errors for; the others feed the filters */
};

/* Twelve planes of a band, and a padded row. */
struct workspace {
	float *memory, *padded;
	struct planes pics[2];
	float *edges[2], *points[2], *scratch, *part;
};

/* Strength of edges and points of one picture's luminance (sec. 4.2). `y` is plane 0 of YCxCz. */
static void find_features(const struct workspace *w, int picture, int width, int height)
{
	const float *y = w->pics[picture].p[0];
	const double sigma = 0.5 * 0.082 * FLIP_PIXELS_PER_DEGREE;
	const int radius = (int)ceil(3 * sigma);
	const size_t n = (size_t)width * (size_t)height;
	struct kernel smooth, first, second;

	make_gaussian(&smooth, radius, 1 / (2 * sigma * sigma));
	first = second = smooth;
	for (int i = -radius; i <= radius; i++) {
		first.w[i + radius] *= (float)-i;
		second.w[i + radius] *= (float)(i * i / (sigma * sigma) - 1);
	}
	normalise(&smooth);
	normalise_signs(&first);
	normalise_signs(&second);

	filter_x(y, w->part, width, height, &smooth, w->padded);
	for (int kind = 0; kind < 2; kind++) {
		const struct kernel *derivative = kind ? &second : &first;
		float *out = kind ? w->points[picture] : w->edges[picture];

		filter_x(y, w->scratch, width, height, derivative, w->padded);
		filter_y(w->scratch, out, width, height, &smooth);
		filter_y(w->part, w->scratch, width, height, derivative);
		for (size_t i = 0; i < n; i++)
			out[i] = length(out[i], w->scratch[i]) / 116; /* constant offsets do not affect derivatives */
	}
}

static int make_workspace(struct workspace *w, uint32_t width, uint32_t height)
{
	enum { PLANES = 12 };
	const size_t n = (size_t)width * (height < BAND + 2 * HALO ? height : BAND + 2 * HALO);
	float *at = w->memory = malloc((n * PLANES + width + 2 * MAX_RADIUS + LANES) * sizeof(*at));

	if (!at)
		return err_report(ERR_SYSTEM, NULL, "out of memory for FLIP of %u x %u pixels", width, height);
	float **const all[PLANES] = { &w->pics[0].p[0], &w->pics[0].p[1], &w->pics[0].p[2], &w->pics[1].p[0], &w->pics[1].p[1],
	                              &w->pics[1].p[2], &w->edges[0], &w->edges[1], &w->points[0], &w->points[1],
	                              &w->scratch, &w->part };

	for (int i = 0; i < PLANES; i++)
		*all[i] = at + (size_t)i * n;
	w->padded = at + (size_t)PLANES * n;
	return 0;
}

static struct band band_at(int y, int height)
{
	struct band b = { .top = y > HALO ? y - HALO : 0, .n_rows = height - y < BAND ? height - y : BAND };
	int end = height - y - b.n_rows > HALO ? y + b.n_rows + HALO : height;

	b.first = y - b.top;
	b.height = end - b.top;
	return b;
}

/** Compute errors of the band's rows from filled planes. With `is_maximum`, `error` keeps larger values it already
 * has. */
static void compare_band(const struct workspace *w, uint32_t width, const struct band *b, int is_maximum, float *error)
{
	const size_t skipped = (size_t)b->first * width, n = (size_t)b->n_rows * width;
	const float max_error = largest_color_error();
	struct planes pics[2];

	for (int i = 0; i < 2; i++) {
		find_features(w, i, (int)width, b->height);
		filter_contrast(&w->pics[i], (int)width, b->height, w->scratch, w->part, w->padded);
		for (int c = 0; c < 3; c++)
			pics[i].p[c] = w->pics[i].p[c] + skipped;
		lab_from_ycxcz(&pics[i], n);
	}
	for (size_t i = 0; i < n; i++) {
		const float lab_a[3] = { pics[0].p[0][i], pics[0].p[1][i], pics[0].p[2][i] };
		const float lab_b[3] = { pics[1].p[0][i], pics[1].p[1][i], pics[1].p[2][i] };
		float edge = fabsf(w->edges[0][skipped + i] - w->edges[1][skipped + i]);
		float point = fabsf(w->points[0][skipped + i] - w->points[1][skipped + i]);
		float feature = sqrtf((edge > point ? edge : point) / sqrtf(2));
		float e = powf(color_error(lab_a, lab_b, max_error), 1 - feature);

		error[i] = is_maximum && error[i] > e ? error[i] : e;
	}
}

static double sum_of(const float *error, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += (double)error[i];
	return sum;
}

int flip_compare(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, float *error, double *mean)
{
	const size_t n = (size_t)width * height;
	struct workspace w = { 0 };
	double sum = 0;
	int err;

	*mean = 0;
	if (memcmp(a, b, 3 * n) == 0) {
		if (error)
			memset(error, 0, n * sizeof(*error));
		return 0;
	}
	err = make_workspace(&w, width, height);
	if (err)
		return err;
	for (int y = 0; y < (int)height; y += BAND) {
		const struct band band = band_at(y, (int)height);
		const size_t at = 3 * (size_t)band.top * width, n_filled = (size_t)band.height * width;
		float *to = error ? error + (size_t)y * width : w.part; /* free by the time errors are written */

		fill_from_codes(a + at, &w.pics[0], n_filled);
		fill_from_codes(b + at, &w.pics[1], n_filled);
		compare_band(&w, width, &band, 0, to);
		sum += sum_of(to, (size_t)band.n_rows * width);
	}
	*mean = sum / (double)n;
	free(w.memory);
	return 0;
}

int flip_compare_hdr(const float *const a[3], const float *const b[3], uint32_t width, uint32_t height, float *error,
                     double *mean)
{
	enum { EXPOSURES = 4 };
	const float start = 0.083f, stop = 3.557f;
	const size_t n = (size_t)width * height, n_bytes = n * sizeof(float);
	struct workspace w = { 0 };
	float *own = NULL;
	double sum = 0;
	int err;

	*mean = 0;
	if (memcmp(a[0], b[0], n_bytes) == 0 && memcmp(a[1], b[1], n_bytes) == 0 && memcmp(a[2], b[2], n_bytes) == 0) {
		if (error)
			memset(error, 0, n_bytes);
		return 0;
	}
	err = make_workspace(&w, width, height);
	if (!err && !error) {
		error = own = malloc((size_t)BAND * width * sizeof(*own));
		if (!error)
			err = err_report(ERR_SYSTEM, NULL, "out of memory for FLIP of %u x %u pixels", width, height);
	}
	for (int y = 0; !err && y < (int)height; y += BAND) {
		const struct band band = band_at(y, (int)height);
		const size_t at = (size_t)band.top * width, n_filled = (size_t)band.height * width;
		float *to = own ? own : error + (size_t)y * width;

		for (int k = 0; k < EXPOSURES; k++) {
			float exposure = start + (stop - start) * (float)k / (EXPOSURES - 1);

			fill_from_linear((const float *const[]){ a[0] + at, a[1] + at, a[2] + at }, exposure, &w.pics[0], n_filled);
			fill_from_linear((const float *const[]){ b[0] + at, b[1] + at, b[2] + at }, exposure, &w.pics[1], n_filled);
			compare_band(&w, width, &band, k > 0, to);
		}
		sum += sum_of(to, (size_t)band.n_rows * width);
	}
	if (!err)
		*mean = sum / (double)n;
	free(w.memory);
	free(own);
	return err;
}

void flip_magma(float value, uint8_t rgb[3])
{
	/* Every eighth of the map's 256 entries, and its last; linear interpolation is within 2 codes of the others. */
	static const uint8_t MAGMA[33][3] = {
		{ 0, 0, 4 }, { 3, 3, 18 }, { 10, 8, 34 }, { 19, 13, 52 }, { 29, 17, 71 }, { 41, 17, 90 }, { 54, 16, 107 },
		{ 68, 15, 118 }, { 81, 18, 124 }, { 93, 23, 127 }, { 106, 28, 129 }, { 118, 33, 129 }, { 131, 38, 129 },
		{ 144, 42, 129 }, { 156, 46, 127 }, { 170, 51, 125 }, { 183, 55, 121 }, { 196, 60, 117 }, { 208, 65, 111 },
		{ 220, 72, 105 }, { 231, 82, 99 }, { 239, 93, 94 }, { 245, 107, 92 }, { 249, 121, 93 }, { 252, 137, 97 },
		{ 253, 152, 105 }, { 254, 167, 114 }, { 254, 182, 124 }, { 254, 196, 136 }, { 254, 211, 149 },
		{ 253, 226, 163 }, { 252, 240, 178 }, { 252, 253, 191 },
	};
	float at = (value > 0 ? value < 1 ? value : 1 : 0) * 255 / 8; /* NaN counts as 0 */
	int i = (int)at;
	/* the last interval is one entry shorter */
	float part = i == 31 ? (at - 31) * 8 / 7 : at - (float)i;

	for (int c = 0; c < 3; c++)
		rgb[c] = (uint8_t)lrintf(MAGMA[i][c] + part * (float)(MAGMA[i + 1][c] - MAGMA[i][c]));
}
