/* Prefix sums: the kernels and their C twins against a plain loop, at sizes around every border of a level. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/frame/stages/scan.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/frame/light/scan.h"

#define MOST (SCAN_CHUNK * SCAN_CHUNK * SCAN_CHUNK + 3)
#define GUARD 16
#define GUARD_WORD 0xa5a5a5a5u

static uint32_t counts[MOST], got[MOST + GUARD];

static void check_scan(struct device *dev, uint32_t n, int kind)
{
	union buffer_uint from = { NULL }, places = { NULL }, scratch = { NULL };
	uint32_t total = 7, want = 0;
	int is_full = 0;

	for (uint32_t i = 0; i < n; i++) /* none, one or none, any, all from the last */
		counts[i] = kind == 0 ? 0 : kind == 1 ? i * 2654435761u >> 31 : kind == 2 ? i * 2654435761u >> 20 : i == n - 1;
	memset(got, 0xa5, sizeof(got));
	ck_assert_int_eq(launch_reserve(dev, from, n), 0);
	ck_assert_int_eq(launch_reserve(dev, places, sizeof(got) / sizeof(got[0])), 0);
	ck_assert_int_eq(device_write(dev, from.buffer, 0, counts, n * sizeof(*counts)), 0);
	ck_assert_int_eq(device_write(dev, places.buffer, 0, got, sizeof(got)), 0);
	ck_assert_int_eq(scan_counts(dev,
	                             &(const struct scan_list){ from, n, n ? counts[n / 2] : 1, &places, &scratch },
	                             &total, &is_full),
	                 0);
	ck_assert_int_eq(is_full, n != 0);
	ck_assert_int_eq(
		scan_counts(dev, &(const struct scan_list){ from, n, 0x7fffffff, &places, &scratch }, &total, &is_full),
		0);
	ck_assert_int_eq(is_full, 0);
	ck_assert_int_eq(device_read(dev, places.buffer, 0, got, sizeof(got)), 0);
	for (uint32_t i = 0; i < n; i++) {
		if (total)
			ck_assert_msg(got[i] == want, "kind %d, place %u of %u is %u, not %u", kind, i, n, got[i], want);
		want += counts[i];
	}
	ck_assert_uint_eq(total, want);
	for (uint32_t i = total ? n : 0; i < n + GUARD; i++)
		ck_assert_msg(got[i] == GUARD_WORD, "data was written past the end, or without an item to place");
	device_release(dev, &from.buffer);
	device_release(dev, &places.buffer);
	device_release(dev, &scratch.buffer);
}

START_TEST(places_are_sums_of_counts)
{
	static const uint32_t sizes[] = { 0, 1, 2, SCAN_CHUNK - 1, SCAN_CHUNK, SCAN_CHUNK + 1, SCAN_CHUNK * SCAN_CHUNK,
		                          SCAN_CHUNK * SCAN_CHUNK + 1, 100000, MOST };
	struct device_description *list = NULL;
	size_t n_devices = 0;
	char number[32];

	if (!lacks_driver())
		ck_assert_int_eq(device_list(&list, &n_devices), 0);
	free(list);
	for (size_t k = 0; k <= n_devices; k++) {
		struct device *dev;

		snprintf(number, sizeof(number), "%zu", k);
		ck_assert_int_eq(device_open(k < n_devices ? number : "reference", 2, &dev), 0);
		for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++)
			for (int kind = 0; kind < 4; kind++)
				check_scan(dev, sizes[i], sizes[i] ? kind : 0);
		device_close(&dev);
	}
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("scan");

	tcase_add_test(tests, places_are_sums_of_counts);
	return run_case(tests, "scan");
}
