/* replay/build/known: areas known from partial clears, compared with a picture of the same clears. */
#include "replay/build/known.h"

#include <stdlib.h>
#include <string.h>

#include "tests/case.h"

enum { WIDTH = 9, HEIGHT = 7, ROUNDS = 1000 };

static unsigned seed = 1;

static int32_t at_most(int32_t n)
{
	return rand_r(&seed) % (n + 1);
}

static void make_part(int32_t out[4])
{
	out[0] = at_most(WIDTH);
	out[1] = at_most(HEIGHT);
	out[2] = at_most(WIDTH - out[0]);
	out[3] = at_most(HEIGHT - out[1]);
}

/* The buffers cleared in every pixel of a part; all of them for an empty part. */
static uint32_t painted(const uint32_t picture[HEIGHT][WIDTH], const int32_t part[4])
{
	uint32_t all = 7;

	for (int32_t y = part[1]; y < part[1] + part[3]; y++)
		for (int32_t x = part[0]; x < part[0] + part[2]; x++)
			all &= picture[y][x];
	return all;
}

START_TEST(test_parts)
{
	unsigned whole = 0;

	for (int round = 0; round < ROUNDS; round++) {
		const int32_t every[4] = { 0, 0, WIDTH, HEIGHT };
		struct gls_known k = { .whole = 0 };
		uint32_t picture[HEIGHT][WIDTH] = { { 0 } };
		int n = 1 + at_most(2 * GLS_KNOWN_PARTS);

		for (int i = 0; i < n; i++) {
			uint32_t buffers = (uint32_t)at_most(7), good;
			int32_t part[4], look[4];

			make_part(part);
			part[2] = at_most(1) ? part[2] : WIDTH - part[0]; /* up to the border */
			part[3] = at_most(1) ? part[3] : HEIGHT - part[1];
			gls_known_clear(&k, buffers, (const uint32_t[2]){ WIDTH, HEIGHT }, part);
			for (int32_t y = part[1]; y < part[1] + part[3]; y++)
				for (int32_t x = part[0]; x < part[0] + part[2]; x++)
					picture[y][x] |= buffers;
			make_part(look);
			good = 7 & ~gls_known_lacks(&k, 7, look);
			ck_assert_uint_eq(good & ~painted(picture, look), 0); /* never more than true */
			ck_assert_uint_eq(k.whole & ~painted(picture, every), 0);
			if (i < GLS_KNOWN_PARTS) { /* and all that is true, while there is room */
				ck_assert_uint_eq(good, painted(picture, look));
				ck_assert_uint_eq(k.whole, painted(picture, every));
			}
		}
		whole += k.whole != 0;
	}
	ck_assert_uint_gt(whole, ROUNDS / 20);
}
END_TEST

START_TEST(test_full)
{
	struct gls_known k = { .whole = 0 };

	for (int32_t i = 0; i < 2 * GLS_KNOWN_PARTS; i++)
		gls_known_clear(&k, 1, (const uint32_t[2]){ 100, 1 }, (const int32_t[4]){ 2 * i, 0, 1, 1 });
	ck_assert_uint_eq(k.n[0], GLS_KNOWN_PARTS);
	gls_known_clear(&k, 3, (const uint32_t[2]){ 100, 1 }, (const int32_t[4]){ 0, 0, 100, 1 });
	ck_assert_uint_eq(k.whole, 3);
	ck_assert_uint_eq(gls_known_lacks(&k, 7, (const int32_t[4]){ 0, 0, 100, 1 }), 4);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("known");

	tcase_add_test(tests, test_parts);
	tcase_add_test(tests, test_full);
	return run_case(tests, "known");
}
