/* replay/pack: data survives packing, and incompressible data is stored as it is. */
#include "replay/index/pack.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tests/case.h"

#define MAX_BYTES 100000u

/* Fill data with a pattern after `noisy` bytes of noise. */
static void fill(char *data, size_t n, size_t noisy)
{
	uint32_t x = 1;

	for (size_t i = 0; i < n; i++) {
		x = x * 1664525u + 1013904223u;
		data[i] = i < noisy ? (char)(x >> 24) : (char)(i / 64);
	}
}

static size_t there_and_back(size_t n, size_t noisy)
{
	static char data[MAX_BYTES];
	char *packed = malloc(pack_room(n) + 1), *back;
	size_t n_packed = 0;

	fill(data, n, noisy);
	ck_assert_int_eq(pack_blob(data, n, packed, &n_packed), 0);
	ck_assert_uint_le(n_packed, n);
	back = unpack_blob(packed, n_packed, n);
	ck_assert_ptr_nonnull(back);
	ck_assert_int_eq(back == packed, n_packed == n);
	ck_assert_mem_eq(back, data, n);
	if (back != packed)
		free(back);
	free(packed);
	return n_packed;
}

START_TEST(test_sizes)
{
	for (size_t n = 1; n <= MAX_BYTES; n += 1 + n / 3)
		for (size_t quarter = 0; quarter <= 4; quarter++)
			there_and_back(n, n * quarter / 4);
}
END_TEST

START_TEST(test_worth)
{
	ck_assert_uint_lt(there_and_back(MAX_BYTES, 0), MAX_BYTES / 4);
	ck_assert_uint_lt(there_and_back(MAX_BYTES, MAX_BYTES / 4), MAX_BYTES / 4 * 3);
	ck_assert_uint_eq(there_and_back(MAX_BYTES, MAX_BYTES), MAX_BYTES);
	ck_assert_uint_eq(there_and_back(100, 100), 100);
}
END_TEST

/* An index is untrusted: bytes that are not Snappy, or have another size. */
START_TEST(test_damaged)
{
	char data[1000], packed[2000];
	size_t n_packed;

	fill(data, sizeof(data), 0);
	ck_assert_int_eq(pack_blob(data, sizeof(data), packed, &n_packed), 0);
	ck_assert_ptr_null(unpack_blob(packed, n_packed, sizeof(data) - 1));
	ck_assert_ptr_null(unpack_blob(packed, n_packed, sizeof(data) + 1));
	ck_assert_ptr_null(unpack_blob(packed, n_packed - 1, sizeof(data)));
	ck_assert_ptr_null(unpack_blob(packed, 0, sizeof(data)));
	memset(packed, 0xff, sizeof(packed));
	ck_assert_ptr_null(unpack_blob(packed, n_packed, sizeof(data)));
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("pack");

	tcase_add_test(tcase, test_sizes);
	tcase_add_test(tcase, test_worth);
	tcase_add_test(tcase, test_damaged);
	return run_case(tcase, "pack");
}
