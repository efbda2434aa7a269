/*
 * Calls in any order with any values (calls.h): the state machine stays in one piece, and what is saved between two frames is
 * what is loaded. The kept ones are what libFuzzer found worth keeping, with every sequence that ever broke something.
 */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/fuzz/calls.h"

#define KEPT "tests/fuzz/kept_calls"
#define LARGEST 65536
#define N_RANDOM 400
#define CALLS_A_RUN 300

static uint8_t bytes[LARGEST];

/* How they are packed is said in pack_calls.py. */
START_TEST(kept_sequences)
{
	FILE *file = fopen(KEPT, "rb");
	uint8_t head[4];
	int n = 0;

	ck_assert_msg(file != NULL, "no " KEPT);
	for (; fread(head, 1, 4, file) == 4; n++) {
		size_t size = head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16 | (size_t)head[3] << 24;
		ck_assert_msg(size <= LARGEST && fread(bytes, 1, size, file) == size, KEPT ": number %d is not whole", n);
		ck_assert_msg(!calls_run(bytes, size), KEPT ": number %d: saved and loaded states differ", n);
	}
	fclose(file);
	ck_assert_int_gt(n, 1000);
}
END_TEST

START_TEST(random_sequences)
{
	uint64_t state = (uint64_t)_i + 1;

	for (int run = 0; run < N_RANDOM / 4; run++) {
		for (size_t i = 0; i < CALLS_A_RUN * CALLS_SLOT; i++) {
			state = state * 6364136223846793005u + 1442695040888963407u;
			bytes[i] = (uint8_t)(state >> 56);
		}
		ck_assert_msg(!calls_run(bytes, CALLS_A_RUN * CALLS_SLOT), "part %d, run %d: saved and loaded states differ", _i, run);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("calls");
	Suite *suite = suite_create("calls");
	SRunner *runner;
	int failed;

	tcase_add_test(tcase, kept_sequences);
	tcase_add_loop_test(tcase, random_sequences, 0, 4);
	suite_add_tcase(suite, tcase);
	runner = srunner_create(suite);
	srunner_run_all(runner, CK_NORMAL);
	failed = srunner_ntests_failed(runner);
	srunner_free(runner);
	return failed != 0;
}
