/* Pieces made by several threads arrive in order, see the same costs in every run, and stop at the first failure. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "diff/report/ordered.h"
#include "tests/case.h"

enum { N = 200, FAILS_AT = 90 };

static size_t spent_at[N];

/** Piece i costs i, and takes longer if i is a multiple of 7. */
static int make(void *context, size_t i, size_t spent, FILE *out, size_t *cost)
{
	const size_t *fails_at = context;

	if (i % 7 == 0)
		usleep(2000);
	spent_at[i] = spent;
	*cost = i;
	fprintf(out, "%zu\n", i);
	return i == *fails_at ? ERR_INPUT : 0;
}

START_TEST(pieces_arrive_in_order)
{
	size_t fails_at = N, bytes;
	char *text, *at;
	FILE *out = open_memstream(&text, &bytes);

	ck_assert_int_eq(ordered_write(N, make, &fails_at, out), 0);
	fclose(out);
	at = text;
	for (size_t i = 0; i < N; i++)
		ck_assert_uint_eq(strtoul(at, &at, 10), i);
	ck_assert_str_eq(at, "\n");
	free(text);
}
END_TEST

START_TEST(costs_are_those_of_pieces_long_before)
{
	size_t fails_at = N;
	FILE *out = fopen("/dev/null", "w");

	ck_assert_int_eq(ordered_write(N, make, &fails_at, out), 0);
	fclose(out);
	for (size_t i = 0; i < N; i++) {
		size_t n = i < ORDERED_AHEAD ? 0 : i - ORDERED_AHEAD + 1;

		ck_assert_uint_eq(spent_at[i], n ? n * (n - 1) / 2 : 0);
	}
}
END_TEST

START_TEST(a_failure_ends_the_run)
{
	size_t fails_at = FAILS_AT, bytes, last = 0;
	char *text, *at;
	FILE *out = open_memstream(&text, &bytes);

	ck_assert_int_eq(ordered_write(N, make, &fails_at, out), ERR_INPUT);
	fclose(out);
	for (at = text; *at; at += strcspn(at, "\n") + 1)
		last = strtoul(at, NULL, 10);
	ck_assert_uint_lt(last, FAILS_AT);
	free(text);
}
END_TEST

START_TEST(nothing_is_nothing)
{
	size_t fails_at = N;

	ck_assert_int_eq(ordered_write(0, make, &fails_at, stdout), 0);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("ordered");

	tcase_add_test(tcase, pieces_arrive_in_order);
	tcase_add_test(tcase, costs_are_those_of_pieces_long_before);
	tcase_add_test(tcase, a_failure_ends_the_run);
	tcase_add_test(tcase, nothing_is_nothing);
	return run_case(tcase, "ordered");
}
