/*
 * FLIP against its authors' implementation: values from the Python package flip-evaluator 1.7 (LDR, default 67.0206
 * pixels per degree) on patterns that both sides generate by the same rule.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diff/score/flip.h"
#include "tests/case.h"

enum { WIDTH = 64, HEIGHT = 48, N = WIDTH * HEIGHT };

static uint8_t a[N * 3], b[N * 3];
static float error[N];

static void fill(uint8_t *pixels, uint8_t r, uint8_t g, uint8_t blue)
{
	for (int i = 0; i < N; i++) {
		pixels[3 * i] = r;
		pixels[3 * i + 1] = g;
		pixels[3 * i + 2] = blue;
	}
}

static void fill_pattern(uint8_t *pixels, int width, int height, int seed)
{
	for (int y = 0; y < height; y++)
		for (int x = 0; x < width; x++)
			for (int c = 0; c < 3; c++)
				pixels[3 * (y * width + x) + c] = (uint8_t)(x * 7 + y * 13 + c * 29 + (x * y) % 17 * seed +
				                                            (x / 8 + y / 8) % 2 * 90);
}

static double mean_error(void)
{
	double mean = -1;

	ck_assert_int_eq(flip_compare(a, b, WIDTH, HEIGHT, error, &mean), 0);
	return mean;
}

START_TEST(even_shift_of_grey)
{
	static const struct { uint8_t step; double mean; } known[] = {
		{ 1, 0.02986208 }, { 2, 0.04849235 }, { 4, 0.07869052 }, { 8, 0.12759341 },
	};

	fill(a, 128, 128, 128);
	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++) {
		uint8_t g = (uint8_t)(128 + known[i].step);

		fill(b, g, g, g);
		ck_assert_double_eq_tol(mean_error(), known[i].mean, 1e-4);
	}
}
END_TEST

START_TEST(extremes)
{
	fill(a, 0, 0, 0);
	fill(b, 255, 255, 255);
	ck_assert_double_eq_tol(mean_error(), 0.96736527, 1e-4);
	fill(a, 0, 255, 0);
	fill(b, 0, 0, 255);
	ck_assert_double_eq_tol(mean_error(), 1, 1e-5);
}
END_TEST

START_TEST(patterns)
{
	static const struct { int seed_a, seed_b; double mean, corner, middle, max; } known[] = {
		{ 1, 2, 0.26676348, 0.02735619, 0.18234183, 0.8948582 },
		{ 3, 5, 0.37462291, 0.05345648, 0.30391368, 0.9687722 },
		{ 0, 1, 0.25861990, 0.02728712, 0.18968128, 0.7551639 },
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++) {
		float max = 0;

		fill_pattern(a, WIDTH, HEIGHT, known[i].seed_a);
		fill_pattern(b, WIDTH, HEIGHT, known[i].seed_b);
		ck_assert_double_eq_tol(mean_error(), known[i].mean, 1e-4);
		ck_assert_double_eq_tol((double)error[0], known[i].corner, 1e-4);
		ck_assert_double_eq_tol((double)error[24 * WIDTH + 32], known[i].middle, 1e-4);
		for (int p = 0; p < N; p++)
			max = fmaxf(max, error[p]);
		ck_assert_double_eq_tol((double)max, known[i].max, 1e-4);
	}
}
END_TEST

START_TEST(shifted_by_one_pixel)
{
	fill_pattern(a, WIDTH, HEIGHT, 1);
	for (int y = 0; y < HEIGHT; y++)
		for (int x = 0; x < WIDTH; x++)
			memcpy(b + 3 * (y * WIDTH + x), a + 3 * (y * WIDTH + (x + WIDTH - 1) % WIDTH), 3);
	ck_assert_double_eq_tol(mean_error(), 0.31367493, 1e-4);
	ck_assert_double_eq_tol((double)error[N - 1], 0.33023635, 1e-4);
}
END_TEST

START_TEST(a_box_and_a_dot)
{
	fill(a, 20, 20, 20);
	fill(b, 20, 20, 20);
	for (int y = 10; y < 20; y++)
		for (int x = 10; x < 30; x++)
			memcpy(b + 3 * (y * WIDTH + x), (uint8_t[]){ 200, 40, 40 }, 3);
	ck_assert_double_eq_tol(mean_error(), 0.09612981, 1e-4);
	ck_assert_double_eq_tol((double)error[15 * WIDTH + 20], 0.9657576, 1e-4);
	ck_assert_double_eq_tol((double)error[10 * WIDTH + 10], 0.83141005, 1e-4);
	ck_assert_double_eq_tol((double)error[5 * WIDTH + 5], 0.00751097, 1e-4);
	ck_assert_double_eq_tol((double)error[24 * WIDTH + 40], 0, 1e-6);

	fill(b, 20, 20, 20);
	memset(b + 3 * (24 * WIDTH + 32), 255, 3);
	ck_assert_double_eq_tol(mean_error(), 0.00426538, 1e-5);
	ck_assert_double_eq_tol((double)error[24 * WIDTH + 32], 0.8050032, 1e-4);
	ck_assert_double_eq_tol((double)error[24 * WIDTH + 35], 0.13283536, 1e-4);
}
END_TEST

START_TEST(smaller_than_the_filters)
{
	double mean;

	fill_pattern(a, 15, 7, 1);
	fill_pattern(b, 15, 7, 4);
	ck_assert_int_eq(flip_compare(a, b, 15, 7, error, &mean), 0);
	ck_assert_double_eq_tol(mean, 0.48898369, 1e-4);
	ck_assert_double_eq_tol((double)error[3 * 15 + 7], 0.40898052, 1e-4);
	a[0] = a[1] = a[2] = 0;
	b[0] = b[1] = b[2] = 255;
	ck_assert_int_eq(flip_compare(a, b, 1, 1, NULL, &mean), 0);
	ck_assert_double_gt(mean, 0.9);
}
END_TEST

START_TEST(equal_pictures)
{
	fill_pattern(a, WIDTH, HEIGHT, 3);
	memcpy(b, a, sizeof(a));
	error[7] = 1;
	ck_assert_double_eq(mean_error(), 0);
	ck_assert_float_eq(error[7], 0);
}
END_TEST

START_TEST(magma_has_its_ends)
{
	uint8_t rgb[3];

	flip_magma(0, rgb);
	ck_assert_mem_eq(rgb, ((uint8_t[]){ 0, 0, 4 }), 3);
	flip_magma(1, rgb);
	ck_assert_mem_eq(rgb, ((uint8_t[]){ 252, 253, 191 }), 3);
	flip_magma(128 / 255.0f, rgb);
	ck_assert_mem_eq(rgb, ((uint8_t[]){ 183, 55, 121 }), 3);
	flip_magma(NAN, rgb);
	ck_assert_mem_eq(rgb, ((uint8_t[]){ 0, 0, 4 }), 3);
	flip_magma(7, rgb);
	ck_assert_mem_eq(rgb, ((uint8_t[]){ 252, 253, 191 }), 3);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("flip");

	tcase_add_test(tests, even_shift_of_grey);
	tcase_add_test(tests, extremes);
	tcase_add_test(tests, patterns);
	tcase_add_test(tests, shifted_by_one_pixel);
	tcase_add_test(tests, a_box_and_a_dot);
	tcase_add_test(tests, smaller_than_the_filters);
	tcase_add_test(tests, equal_pictures);
	tcase_add_test(tests, magma_has_its_ends);
	return run_case(tests, "flip");
}
