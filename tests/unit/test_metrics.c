/*
 * Metrics without a gate, against published and independent values: the 34 pairs of Sharma, Wu and Dalal 2005 (table 1)
 * for CIEDE2000; SSIM, MS-SSIM and PSNR against values computed independently from their definitions.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/metrics.h"
#include "tests/case.h"

static const struct { double a[3], b[3], difference; } sharma[] = {
	{ { 50.0000, 2.6772, -79.7751 }, { 50.0000, 0.0000, -82.7485 }, 2.0425 },
	{ { 50.0000, 3.1571, -77.2803 }, { 50.0000, 0.0000, -82.7485 }, 2.8615 },
	{ { 50.0000, 2.8361, -74.0200 }, { 50.0000, 0.0000, -82.7485 }, 3.4412 },
	{ { 50.0000, -1.3802, -84.2814 }, { 50.0000, 0.0000, -82.7485 }, 1.0000 },
	{ { 50.0000, -1.1848, -84.8006 }, { 50.0000, 0.0000, -82.7485 }, 1.0000 },
	{ { 50.0000, -0.9009, -85.5211 }, { 50.0000, 0.0000, -82.7485 }, 1.0000 },
	{ { 50.0000, 0.0000, 0.0000 }, { 50.0000, -1.0000, 2.0000 }, 2.3669 },
	{ { 50.0000, -1.0000, 2.0000 }, { 50.0000, 0.0000, 0.0000 }, 2.3669 },
	{ { 50.0000, 2.4900, -0.0010 }, { 50.0000, -2.4900, 0.0009 }, 7.1792 },
	{ { 50.0000, 2.4900, -0.0010 }, { 50.0000, -2.4900, 0.0010 }, 7.1792 },
	{ { 50.0000, 2.4900, -0.0010 }, { 50.0000, -2.4900, 0.0011 }, 7.2195 },
	{ { 50.0000, 2.4900, -0.0010 }, { 50.0000, -2.4900, 0.0012 }, 7.2195 },
	{ { 50.0000, -0.0010, 2.4900 }, { 50.0000, 0.0009, -2.4900 }, 4.8045 },
	{ { 50.0000, -0.0010, 2.4900 }, { 50.0000, 0.0010, -2.4900 }, 4.8045 },
	{ { 50.0000, -0.0010, 2.4900 }, { 50.0000, 0.0011, -2.4900 }, 4.7461 },
	{ { 50.0000, 2.5000, 0.0000 }, { 50.0000, 0.0000, -2.5000 }, 4.3065 },
	{ { 50.0000, 2.5000, 0.0000 }, { 73.0000, 25.0000, -18.0000 }, 27.1492 },
	{ { 50.0000, 2.5000, 0.0000 }, { 61.0000, -5.0000, 29.0000 }, 22.8977 },
	{ { 50.0000, 2.5000, 0.0000 }, { 56.0000, -27.0000, -3.0000 }, 31.9030 },
	{ { 50.0000, 2.5000, 0.0000 }, { 58.0000, 24.0000, 15.0000 }, 19.4535 },
	{ { 50.0000, 2.5000, 0.0000 }, { 50.0000, 3.1736, 0.5854 }, 1.0000 },
	{ { 50.0000, 2.5000, 0.0000 }, { 50.0000, 3.2972, 0.0000 }, 1.0000 },
	{ { 50.0000, 2.5000, 0.0000 }, { 50.0000, 1.8634, 0.5757 }, 1.0000 },
	{ { 50.0000, 2.5000, 0.0000 }, { 50.0000, 3.2592, 0.3350 }, 1.0000 },
	{ { 60.2574, -34.0099, 36.2677 }, { 60.4626, -34.1751, 39.4387 }, 1.2644 },
	{ { 63.0109, -31.0961, -5.8663 }, { 62.8187, -29.7946, -4.0864 }, 1.2630 },
	{ { 61.2901, 3.7196, -5.3901 }, { 61.4292, 2.2480, -4.9620 }, 1.8731 },
	{ { 35.0831, -44.1164, 3.7933 }, { 35.0232, -40.0716, 1.5901 }, 1.8645 },
	{ { 22.7233, 20.0904, -46.6940 }, { 23.0331, 14.9730, -42.5619 }, 2.0373 },
	{ { 36.4612, 47.8580, 18.3852 }, { 36.2715, 50.5065, 21.2231 }, 1.4146 },
	{ { 90.8027, -2.0831, 1.4410 }, { 91.1528, -1.6435, 0.0447 }, 1.4441 },
	{ { 90.9257, -0.5406, -0.9208 }, { 88.6381, -0.8985, -0.7239 }, 1.5381 },
	{ { 6.7747, -0.2908, -2.4247 }, { 5.8714, -0.0985, -2.2286 }, 0.6377 },
	{ { 2.0776, 0.0795, -1.1350 }, { 0.9033, -0.0636, -0.5514 }, 0.9082 },
};

START_TEST(ciede2000_of_sharma)
{
	ck_assert_uint_eq(sizeof(sharma) / sizeof(sharma[0]), 34);
	for (size_t i = 0; i < 34; i++) {
		ck_assert_double_eq_tol(metric_ciede2000(sharma[i].a, sharma[i].b), sharma[i].difference, 5.1e-5);
		ck_assert_double_eq_tol(metric_ciede2000(sharma[i].b, sharma[i].a), sharma[i].difference, 5.1e-5);
	}
}
END_TEST

START_TEST(lab)
{
	double lab[3];

	metric_lab_from_linear((double[]){ 1, 1, 1 }, lab);
	ck_assert_double_eq_tol(lab[0], 100, 1e-9);
	ck_assert_double_eq_tol(lab[1], 0, 1e-9);
	ck_assert_double_eq_tol(lab[2], 0, 1e-9);
	metric_lab_from_linear((double[]){ 1, 0, 0 }, lab); /* sRGB's red, as in published tables */
	ck_assert_double_eq_tol(lab[0], 53.24, 0.01);
	ck_assert_double_eq_tol(lab[1], 80.09, 0.01);
	ck_assert_double_eq_tol(lab[2], 67.20, 0.01);
}
END_TEST

enum { WIDTH = 200, HEIGHT = 180, N = WIDTH * HEIGHT };
static uint8_t a[3 * N], b[3 * N];

static void fill(uint8_t *pixels, int seed)
{
	for (int y = 0; y < HEIGHT; y++)
		for (int x = 0; x < WIDTH; x++)
			for (int c = 0; c < 3; c++)
				pixels[3 * (y * WIDTH + x) + c] = (uint8_t)((x * 3 + y * 2 + c * 40 + (x * y) % 23 * seed) % 256);
}

static double similarity(int (*metric)(const uint8_t *, const uint8_t *, uint32_t, uint32_t, double *),
                         const uint8_t *one, const uint8_t *two, uint32_t width, uint32_t height)
{
	double out = -1;

	ck_assert_int_eq(metric(one, two, width, height, &out), 0);
	return out;
}

START_TEST(ssim)
{
	fill(a, 1);
	fill(b, 3);
	ck_assert_double_eq_tol(similarity(metric_ssim, a, b, WIDTH, HEIGHT), 0.4366558348, 1e-9); /* scikit-image 0.26.0 */
	ck_assert_double_eq_tol(similarity(metric_ms_ssim, a, b, WIDTH, HEIGHT), 0.6991122712, 1e-9);
	ck_assert_double_eq_tol(similarity(metric_ssim, a, a, WIDTH, HEIGHT), 1, 1e-12);
	ck_assert_double_eq_tol(similarity(metric_ms_ssim, b, b, WIDTH, HEIGHT), 1, 1e-12);
	ck_assert(isnan(similarity(metric_ssim, a, b, 10, 100)));
	ck_assert(isnan(similarity(metric_ms_ssim, a, b, 175, 180)));
}
END_TEST

START_TEST(psnr)
{
	fill(a, 1);
	memcpy(b, a, sizeof(a));
	ck_assert(isinf(metric_psnr_db(a, b, N)));
	for (int i = 0; i < 3 * N; i++)
		b[i] = (uint8_t)(a[i] ^ 1); /* one code off everywhere: 20 log10 255 */
	ck_assert_double_eq_tol(metric_psnr_db(a, b, N), 48.1308036, 1e-6);
}
END_TEST

static double p95(void)
{
	double out = -1;

	ck_assert_int_eq(metric_ciede2000_p95(a, b, N, &out), 0);
	return out;
}

START_TEST(ciede2000_percentile)
{
	memset(a, 100, sizeof(a));
	memcpy(b, a, sizeof(a));
	ck_assert_double_eq(p95(), 0);
	memset(b, 200, 3 * N / 25); /* 4 % of the pixels */
	ck_assert_double_eq(p95(), 0);
	memset(b, 200, 3 * N / 10);
	ck_assert_double_gt(p95(), 20);
}
END_TEST

/* Too many pixels for memory: an error, not a missing figure. */
START_TEST(without_memory)
{
	const uint32_t much = 1u << 24;
	double out;

	ck_assert_int_eq(metric_ssim(a, b, much, much, &out), ERR_SYSTEM);
	ck_assert_int_eq(metric_ms_ssim(a, b, much, much, &out), ERR_SYSTEM);
	ck_assert_int_eq(metric_ciede2000_p95(a, b, (size_t)much * much, &out), ERR_SYSTEM);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("metrics");

	tcase_add_test(tests, ciede2000_of_sharma);
	tcase_add_test(tests, lab);
	tcase_add_test(tests, ssim);
	tcase_add_test(tests, psnr);
	tcase_add_test(tests, ciede2000_percentile);
#ifndef __SANITIZE_ADDRESS__ /* which would end the process */
	tcase_add_test(tests, without_memory);
#endif
	return run_case(tests, "metrics");
}
