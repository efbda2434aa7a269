/* verbs/farm/spans: frame numbers as text. */
#include <stdlib.h>
#include <string.h>

#include "tests/case.h"
#include "verbs/farm/spans.h"

/* A list of frames that ends with -1 must become this text. */
static void check_words(const int *frames, const char *words)
{
	char *text = NULL;
	size_t n = 0;
	FILE *memory = open_memstream(&text, &n);
	struct spans spans = { .out = memory };

	for (; *frames >= 0; frames++)
		spans_add(&spans, (uint64_t)*frames);
	spans_end(&spans);
	fclose(memory);
	ck_assert_str_eq(text, words);
	free(text);
}

#define CHECK_WORDS(words, ...) check_words((const int[]){ __VA_ARGS__, -1 }, words)

START_TEST(test_runs)
{
	check_words((const int[]){ -1 }, "");
	CHECK_WORDS("7", 7);
	CHECK_WORDS("7-8", 7, 8);
	CHECK_WORDS("7,9", 7, 9);
	CHECK_WORDS("0-4", 0, 1, 2, 3, 4);
	CHECK_WORDS("0-20x5", 0, 5, 10, 15, 20);
	CHECK_WORDS("0,5-8", 0, 5, 6, 7, 8);
	CHECK_WORDS("0-2,10-30x10,31", 0, 1, 2, 10, 20, 30, 31);
	CHECK_WORDS("2,4-6,9", 2, 4, 5, 6, 9);
}
END_TEST

START_TEST(test_long_lists)
{
	char *text = NULL;
	size_t n = 0;
	FILE *memory = open_memstream(&text, &n);
	struct spans spans = { .out = memory };

	for (uint64_t frame = 0, step = 2; frame < 4000; frame += step++)
		spans_add(&spans, frame);
	spans_end(&spans);
	fclose(memory);
	ck_assert_uint_lt(strlen(text), 100);
	ck_assert_str_eq(text + strlen(text) - 4, ",...");
	free(text);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("spans");

	tcase_add_test(tcase, test_runs);
	tcase_add_test(tcase, test_long_lists);
	return run_case(tcase, "spans");
}
