/*
 * Calls in any order with any values (calls.h): the state machine must not crash, and a state saved between two frames
 * must be restored exactly. The kept inputs were found by libFuzzer, and include every sequence that ever failed.
 */
#include <stdio.h>
#include <stdlib.h>

#include "tests/case.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/kept.h"

#define N_RANDOM 100
#define CALLS_A_RUN 300
#define N_PARTS 4

static uint8_t bytes[KEPT_LARGEST];

START_TEST(kept_sequences)
{
	FILE *file = fopen(KEPT, "rb");
	size_t size;
	int n = 0;

	ck_assert_msg(file != NULL, "no " KEPT);
	for (; kept_next(file, bytes, &size); n++)
		ck_assert_msg(!calls_run(bytes, size, &calls_grey), KEPT ": number %d: saved and loaded states differ", n);
	fclose(file);
	ck_assert_int_gt(n, 1000);
}
END_TEST

START_TEST(random_sequences)
{
	unsigned state = (unsigned)_i;

	for (int run = 0; run < N_RANDOM; run++) {
		unsigned n = CALLS_A_RUN + (unsigned)run / 2 % 4;

		for (unsigned i = 0; i < n; i++)
			calls_invent(&state, bytes + (size_t)i * CALLS_SLOT, i ? bytes + (size_t)(i - 1) * CALLS_SLOT : NULL);
		ck_assert_msg(!calls_run(bytes, n * CALLS_SLOT, run % 2 ? &calls_grey : NULL),
		              "part %d, run %d: saved and loaded states differ", _i, run);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("calls");

	tcase_add_test(tcase, kept_sequences);
	tcase_add_loop_test(tcase, random_sequences, 0, N_PARTS);
	return run_case(tcase, "calls");
}
