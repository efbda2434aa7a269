/* Picture metrics: PSNR, RMSE, SSIM, CIEDE2000. */
#include "diff/score/metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

/** sRGB's transfer function for all codes, in double precision: tests compare metrics to a millionth. */
static void fill_linear(double linear[256])
{
	for (int i = 0; i < 256; i++) {
		double v = i / 255.0;

		linear[i] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
	}
}

/** Sum of squared differences of codes. */
static double squared_error(const uint8_t *a, const uint8_t *b, size_t n)
{
	uint64_t sum = 0;

	for (size_t i = 0; i < n; i++) {
		int d = a[i] - b[i];

		sum += (uint64_t)(d * d);
	}
	return (double)sum;
}

double metric_psnr_db(const uint8_t *a, const uint8_t *b, size_t n_pixels)
{
	double sum = squared_error(a, b, 3 * n_pixels);

	return sum == 0 ? INFINITY : 10 * log10(255.0 * 255.0 / (sum / (3.0 * (double)n_pixels)));
}

double metric_rmse(const uint8_t *a, const uint8_t *b, size_t n_pixels)
{
	return n_pixels ? sqrt(squared_error(a, b, 3 * n_pixels) / (3.0 * (double)n_pixels)) / 255 : 0;
}

double metric_mrse(const uint8_t *ref, const uint8_t *test, size_t n_pixels)
{
	double sum = 0, linear[256];

	fill_linear(linear);
	for (size_t i = 0; i < 3 * n_pixels; i++) {
		double r = linear[ref[i]], d = linear[test[i]] - r;

		if (d != 0)
			sum += d * d / (r * r + 0.01);
	}
	return n_pixels ? sum / (3.0 * (double)n_pixels) : 0;
}

/* --- Structural similarity --------------------------------------------------------------------------------------- */

enum { SSIM_SIZE = 11, MS_SCALES = 5 };

/* Gaussian of sigma 1.5 over 11 samples, sum 1. */
static void make_window(double w[SSIM_SIZE])
{
	double sum = 0;

	for (int i = 0; i < SSIM_SIZE; i++) {
		int x = i - SSIM_SIZE / 2;

		w[i] = exp(-x * x / (2 * 1.5 * 1.5));
		sum += w[i];
	}
	for (int i = 0; i < SSIM_SIZE; i++)
		w[i] /= sum;
}

/*
 * Weighted moments of one row of windows: means of a, b, a^2, b^2, ab. `columns` is [5][width] scratch for the vertical
 * sums, whose horizontal sums are the moments.
 */
static void sum_columns(const double *a, const double *b, uint32_t width, uint32_t y, const double *w, double *columns)
{
	memset(columns, 0, 5 * (size_t)width * sizeof(*columns));
	for (uint32_t i = 0; i < SSIM_SIZE; i++) {
		const double *ra = a + (size_t)(y + i) * width, *rb = b + (size_t)(y + i) * width;

		for (uint32_t x = 0; x < width; x++) {
			columns[x] += w[i] * ra[x];
			columns[width + x] += w[i] * rb[x];
			columns[2 * (size_t)width + x] += w[i] * ra[x] * ra[x];
			columns[3 * (size_t)width + x] += w[i] * rb[x] * rb[x];
			columns[4 * (size_t)width + x] += w[i] * ra[x] * rb[x];
		}
	}
}

/* Two planes of luma, and room for sum_columns. */
struct plane_pair {
	double *a, *b, *columns;
	uint32_t width, height;
};

/** Mean SSIM, and mean of its contrast and structure part, of two planes in [0,255]. */
static void ssim_of_planes(const struct plane_pair *p, double *ssim, double *contrast)
{
	const uint32_t width = p->width, height = p->height;
	double *columns = p->columns;
	const double c1 = (0.01 * 255) * (0.01 * 255), c2 = (0.03 * 255) * (0.03 * 255);
	double w[SSIM_SIZE], sum = 0, sum_contrast = 0;
	uint32_t n_x = width - SSIM_SIZE + 1, n_y = height - SSIM_SIZE + 1;

	make_window(w);
	for (uint32_t y = 0; y < n_y; y++) {
		sum_columns(p->a, p->b, width, y, w, columns);
		for (uint32_t x = 0; x < n_x; x++) {
			double m[5] = { 0 };

			for (int k = 0; k < 5; k++)
				for (uint32_t i = 0; i < SSIM_SIZE; i++)
					m[k] += w[i] * columns[(size_t)k * width + x + i];
			double var_a = m[2] - m[0] * m[0], var_b = m[3] - m[1] * m[1], cov = m[4] - m[0] * m[1];
			double cs = (2 * cov + c2) / (var_a + var_b + c2);

			sum_contrast += cs;
			sum += cs * (2 * m[0] * m[1] + c1) / (m[0] * m[0] + m[1] * m[1] + c1);
		}
	}
	*ssim = sum / ((double)n_x * n_y);
	*contrast = sum_contrast / ((double)n_x * n_y);
}

static void fill_luma(const uint8_t *rgb, double *luma, size_t n_pixels)
{
	for (size_t i = 0; i < n_pixels; i++)
		luma[i] = 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
}

/* Halve a plane by 2x2 means, in place; an odd last row or column is dropped. */
static void halve(double *plane, uint32_t width, uint32_t height)
{
	for (uint32_t y = 0; y < height / 2; y++) {
		for (uint32_t x = 0; x < width / 2; x++) {
			const double *p = plane + 2 * (size_t)y * width + 2 * x;

			/* overwrites only samples already read */
			plane[(size_t)y * (width / 2) + x] = (p[0] + p[1] + p[width] + p[width + 1]) / 4;
		}
	}
}

static int ssim_over_scales(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, int n_scales,
                            double *out)
{
	static const double exponents[MS_SCALES] = { 0.0448, 0.2856, 0.3001, 0.2363, 0.1333 };
	const size_t n = (size_t)width * height;
	double result = 1, *memory;

	*out = NAN;
	if ((width < height ? width : height) >> (n_scales - 1) < SSIM_SIZE)
		return 0;
	memory = malloc((2 * n + 5 * (size_t)width) * sizeof(*memory));
	if (!memory)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	fill_luma(a, memory, n);
	fill_luma(b, memory + n, n);
	for (int scale = 0; scale < n_scales; scale++) {
		double ssim, contrast;

		ssim_of_planes(&(struct plane_pair){ memory, memory + n, memory + 2 * n, width, height }, &ssim, &contrast);
		if (n_scales == 1) {
			result = ssim;
			break;
		}
		/* a negative mean has no real power; it means that the pictures have nothing in common at this scale */
		result *= pow(fmax(scale == n_scales - 1 ? ssim : contrast, 0), exponents[scale]);
		halve(memory, width, height);
		halve(memory + n, width, height);
		width /= 2;
		height /= 2;
	}
	free(memory);
	*out = result;
	return 0;
}

int metric_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *out)
{
	return ssim_over_scales(a, b, width, height, 1, out);
}

int metric_ms_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *out)
{
	return ssim_over_scales(a, b, width, height, MS_SCALES, out);
}

/* --- Colour difference ------------------------------------------------------------------------------------------- */

void metric_lab_from_linear(const double rgb[3], double lab[3])
{
	/* IEC 61966-2-1's primaries and white point, before rounding */
	static const double m[3][3] = {
		{ 10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794 },
		{ 2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897 },
		{ 1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382 },
	};
	const double delta = 6.0 / 29;
	double f[3];

	for (int i = 0; i < 3; i++) {
		double white = m[i][0] + m[i][1] + m[i][2];
		double t = (m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2]) / white;

		f[i] = t > delta * delta * delta ? cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
	}
	lab[0] = 116 * f[1] - 16;
	lab[1] = 500 * (f[0] - f[1]);
	lab[2] = 200 * (f[1] - f[2]);
}

static const double DEG = 3.14159265358979323846 / 180;

/* Hue angle in degrees, [0,360); 0 for greys. */
static double hue_deg(double a, double b)
{
	double h;

	if (a == 0 && b == 0)
		return 0;
	h = atan2(b, a) / DEG;
	return h < 0 ? h + 360 : h;
}

double metric_ciede2000(const double lab1[3], const double lab2[3])
{
	const double pow25_7 = 6103515625.0;
	double c1 = hypot(lab1[1], lab1[2]), c2 = hypot(lab2[1], lab2[2]);
	double c_mean = (c1 + c2) / 2, c7 = pow(c_mean, 7);
	double g = 0.5 * (1 - sqrt(c7 / (c7 + pow25_7)));
	double a1 = (1 + g) * lab1[1], a2 = (1 + g) * lab2[1];
	double h1 = hue_deg(a1, lab1[2]), h2 = hue_deg(a2, lab2[2]);

	/* differences */
	c1 = hypot(a1, lab1[2]);
	c2 = hypot(a2, lab2[2]);
	double dl = lab2[0] - lab1[0], dc = c2 - c1, dh = h2 - h1;

	if (c1 * c2 == 0)
		dh = 0;
	else if (dh > 180)
		dh -= 360;
	else if (dh < -180)
		dh += 360;
	double dh_chord = 2 * sqrt(c1 * c2) * sin(dh / 2 * DEG);

	/* means */
	double l = (lab1[0] + lab2[0]) / 2, c = (c1 + c2) / 2, h = h1 + h2;

	if (c1 * c2 != 0) {
		if (fabs(h1 - h2) > 180)
			h += h < 360 ? 360 : -360;
		h /= 2;
	}

	/* weights */
	double t = 1 - 0.17 * cos((h - 30) * DEG) + 0.24 * cos(2 * h * DEG) + 0.32 * cos((3 * h + 6) * DEG)
		- 0.20 * cos((4 * h - 63) * DEG);
	double turn = 30 * exp(-((h - 275) / 25) * ((h - 275) / 25));
	double cm7 = pow(c, 7);
	double rc = 2 * sqrt(cm7 / (cm7 + pow25_7));
	double sl = 1 + 0.015 * (l - 50) * (l - 50) / sqrt(20 + (l - 50) * (l - 50));
	double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
	double rt = -sin(2 * turn * DEG) * rc;

	dl /= sl;
	dc /= sc;
	dh_chord /= sh;
	return sqrt(dl * dl + dc * dc + dh_chord * dh_chord + rt * dc * dh_chord);
}

static uint8_t digit_of(double number, int shift)
{
	uint64_t bits;

	memcpy(&bits, &number, sizeof(bits));
	return (uint8_t)(bits >> shift);
}

/*
 * The number at `rank` in sorted order; reorders them. Numbers from 0 on sort like their bits, so each step counts
 * eight bits of the numbers that remain.
 */
static double select_rank(double *numbers, size_t n, size_t rank)
{
	for (int shift = 56; shift >= 0; shift -= 8) {
		size_t counts[256] = { 0 }, left = 0;
		uint8_t digit = 0;

		for (size_t i = 0; i < n; i++)
			counts[digit_of(numbers[i], shift)]++;
		for (; rank >= counts[digit]; digit++)
			rank -= counts[digit];
		for (size_t i = 0; i < n; i++)
			if (digit_of(numbers[i], shift) == digit)
				numbers[left++] = numbers[i];
		n = left;
	}
	return numbers[0];
}

int metric_ciede2000_p95(const uint8_t *a, const uint8_t *b, size_t n_pixels, double *out)
{
	double *differences = malloc((n_pixels ? n_pixels : 1) * sizeof(*differences));
	double linear[256];

	*out = NAN;
	if (!differences)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	fill_linear(linear);
	for (size_t i = 0; i < n_pixels; i++) {
		double rgb[2][3], lab[2][3];

		differences[i] = 0;
		if (memcmp(a + 3 * i, b + 3 * i, 3) == 0)
			continue;
		for (int c = 0; c < 3; c++) {
			rgb[0][c] = linear[a[3 * i + (size_t)c]];
			rgb[1][c] = linear[b[3 * i + (size_t)c]];
		}
		metric_lab_from_linear(rgb[0], lab[0]);
		metric_lab_from_linear(rgb[1], lab[1]);
		differences[i] = metric_ciede2000(lab[0], lab[1]);
	}
	if (n_pixels)
		*out = select_rank(differences, n_pixels, (n_pixels - 1) * 95 / 100);
	free(differences);
	return 0;
}
