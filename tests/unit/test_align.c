/* verbs/bisect/align: the regions between hunks agree, and short scripts are minimal. */
#include "verbs/bisect/align.h"

#include <stdlib.h>

#include "tests/case.h"

enum { MOST = 40, ROUNDS = 3000, LONG = 30000 };

static unsigned seed = 1;

static size_t at_most(size_t n)
{
	return (size_t)rand_r(&seed) % (n + 1);
}

/* @return number of edits in the script */
static size_t check_hunks(const uint64_t *a, size_t n, const uint64_t *b, size_t m)
{
	struct align_hunk *hunks;
	size_t n_hunks, i = 0, j = 0, edits = 0;

	ck_assert_int_eq(align_keys(a, n, b, m, &hunks, &n_hunks), 0);
	for (size_t h = 0; h <= n_hunks; h++) {
		const struct align_hunk end = { n, n, m, m }, *k = h < n_hunks ? &hunks[h] : &end;

		ck_assert_uint_eq(k->a0 - i, k->b0 - j);
		for (; i < k->a0; i++, j++)
			ck_assert_uint_eq(a[i], b[j]);
		edits += k->a1 - k->a0 + k->b1 - k->b0;
		i = k->a1;
		j = k->b1;
	}
	free(hunks);
	return edits;
}

static size_t fewest(const uint64_t *a, size_t n, const uint64_t *b, size_t m)
{
	size_t row[MOST + 1];

	for (size_t j = 0; j <= m; j++)
		row[j] = j;
	for (size_t i = 1; i <= n; i++) {
		size_t before = row[0]++;

		for (size_t j = 1; j <= m; j++) {
			const size_t here = row[j], edits = 1 + (row[j] < row[j - 1] ? row[j] : row[j - 1]);

			row[j] = a[i - 1] == b[j - 1] ? before : edits;
			before = here;
		}
	}
	return row[m];
}

START_TEST(test_shortest)
{
	uint64_t a[MOST], b[MOST];

	for (int round = 0; round < ROUNDS; round++) {
		const size_t n = at_most(MOST), m = at_most(MOST), letters = 1 + at_most(6);

		for (size_t i = 0; i < MOST; i++) {
			a[i] = at_most(letters);
			b[i] = at_most(3) ? a[i] : at_most(letters);
		}
		ck_assert_uint_eq(check_hunks(a, n, b, m), fewest(a, n, b, m));
	}
}
END_TEST

/* Too many differences for a script: elements that are unique in both sequences align them. */
START_TEST(test_long)
{
	uint64_t *a = malloc(LONG * sizeof(*a)), *b = malloc(LONG * sizeof(*b));

	for (size_t i = 0; i < LONG; i++) {
		a[i] = i % 3 ? i : at_most(5);
		b[i] = i % 3 == 1 ? i : LONG + at_most(5);
	}
	ck_assert_uint_eq(check_hunks(a, LONG, b, LONG), 2 * (LONG - LONG / 3));
	for (size_t i = 0; i < LONG; i++)
		b[i] = 2 * LONG + i;
	ck_assert_uint_eq(check_hunks(a, LONG, b, LONG), 2 * LONG);
	free(a);
	free(b);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("align");

	tcase_add_test(tests, test_shortest);
	tcase_add_test(tests, test_long);
	return run_case(tests, "align");
}
