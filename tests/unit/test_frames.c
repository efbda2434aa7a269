/* base/frames: ranges and file name patterns. */
#include "base/frames.h"

#include <stdio.h>

#include "base/err.h"
#include "tests/case.h"

/** The frames below `end` in a list, such as "0 2 4". */
static const char *frames_of(const char *text, uint64_t end)
{
	static char out[256];
	struct frame_list list = { 0 };
	size_t n = 0;

	out[0] = '\0';
	ck_assert_int_eq(frame_list_parse(text, &list), 0);
	for (uint64_t f = 0; f < end; f++)
		if (frame_list_contains(&list, f))
			n += (size_t)snprintf(out + n, sizeof(out) - n, n ? " %d" : "%d", (int)f);
	frame_list_free(&list);
	return out;
}

START_TEST(test_ranges)
{
	ck_assert_str_eq(frames_of("7", 10), "7");
	ck_assert_str_eq(frames_of("2-5", 10), "2 3 4 5");
	ck_assert_str_eq(frames_of("0-9x3", 20), "0 3 6 9");
	ck_assert_str_eq(frames_of("8,1-2,1-4x2", 10), "1 2 3 8");
	ck_assert_str_eq(frames_of("18446744073709551615", 3), "");
	ck_assert_str_eq(frames_of("7-", 10), "7 8 9");
	ck_assert_str_eq(frames_of("5-x2,0", 10), "0 5 7 9");
	ck_assert_str_eq(frames_of("2,8-,4-5", 10), "2 4 5 8 9");
}
END_TEST

START_TEST(test_not_ranges)
{
	static const char *const bad[] = { "",     "x",   "-1", "-",  "5-2", "1-5x", "1-5x0", "1,",
		                           ",1",   "1 2", "1;2", "1.5", "+1",  "1-2-3", "18446744073709551616" };
	struct frame_list list = { 0 };

	for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
		ck_assert_msg(frame_list_parse(bad[i], &list) == ERR_USAGE, "'%s' was accepted as a range", bad[i]);
		ck_assert_ptr_null(list.ranges);
	}
}
END_TEST

/* The frames that must exist, and the number of those that do. */
START_TEST(test_open_ranges)
{
	static const struct { const char *text; uint64_t needed, of_20; } cases[] = {
		{ "7", 7, 1 }, { "1-18", 18, 18 }, { "0-9x4", 8, 3 }, { "15-", 15, 5 }, { "3,15-x2", 15, 4 }, { "15-,17", 15, 5 },
		{ "25-", 25, 0 },
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct frame_list list = { 0 };

		ck_assert_int_eq(frame_list_parse(cases[i].text, &list), 0);
		ck_assert_msg(frame_list_needed(&list) == cases[i].needed, "%s", cases[i].text);
		ck_assert_msg(frame_list_count(&list, 20) == cases[i].of_20, "%s", cases[i].text);
		frame_list_free(&list);
	}
}
END_TEST

/** The frames below 1000 in the i-th of n parts, or "none". */
static const char *chunk_of(const char *text, uint64_t end, uint64_t i, uint64_t n)
{
	static char out[256];
	struct frame_list list = { 0 };
	uint64_t frame = 0;
	size_t at = 0;
	int rc;

	out[0] = '\0';
	if (*text)
		ck_assert_int_eq(frame_list_parse(text, &list), 0);
	rc = frame_list_chunk(&list, end, i, n);
	ck_assert(rc == 0 || rc == 1);
	for (; rc == 0 && frame < 1000 && frame_list_next(&list, frame, &frame); frame++)
		at += (size_t)snprintf(out + at, sizeof(out) - at, at ? " %d" : "%d", (int)frame);
	frame_list_free(&list);
	return rc ? "none" : out;
}

START_TEST(test_chunks)
{
	uint64_t i, n;

	ck_assert_str_eq(chunk_of("", 10, 1, 3), "0 1 2");
	ck_assert_str_eq(chunk_of("", 10, 2, 3), "3 4 5");
	ck_assert_str_eq(chunk_of("", 10, 3, 3), "6 7 8 9");
	ck_assert_str_eq(chunk_of("0-9x3,20", 30, 1, 2), "0 3");
	ck_assert_str_eq(chunk_of("0-9x3,20", 30, 2, 2), "6 9 20");
	ck_assert_str_eq(chunk_of("1-6,2-8x2,8", 30, 2, 3), "3 4"); /* 1 2 | 3 4 | 5 6 8 */
	ck_assert_str_eq(chunk_of("1-6,2-8x2,8", 30, 3, 3), "5 6 8");
	ck_assert_str_eq(chunk_of("5,7", 30, 1, 4), "none");
	ck_assert_str_eq(chunk_of("5,7", 30, 2, 4), "5");
	ck_assert_int_eq(frame_chunk_parse("3/50", &i, &n), 0);
	ck_assert(i == 3 && n == 50);
	ck_assert_int_eq(frame_chunk_parse("0/5", &i, &n), ERR_USAGE);
	ck_assert_int_eq(frame_chunk_parse("6/5", &i, &n), ERR_USAGE);
	ck_assert_int_eq(frame_chunk_parse("1-5", &i, &n), ERR_USAGE);
}
END_TEST

START_TEST(test_last_and_count)
{
	struct frame_list list = { 0 };

	ck_assert_uint_eq(frame_list_last(&list), UINT64_MAX);
	ck_assert_uint_eq(frame_list_count(&list, 12), 12);
	ck_assert_int_eq(frame_list_parse("3-10x4,5-7,6", &list), 0);
	ck_assert_uint_eq(frame_list_last(&list), 7); /* 3, 7; not 10, which the step skips */
	ck_assert_uint_eq(frame_list_count(&list, 100), 4);
	ck_assert_uint_eq(frame_list_count(&list, 6), 2);
	frame_list_free(&list);
	ck_assert_int_eq(frame_list_parse("3,6-x10", &list), 0);
	ck_assert_uint_eq(frame_list_last(&list), UINT64_MAX); /* for any step */
	frame_list_free(&list);
}
END_TEST

/* A mistyped number names more frames than can be counted one by one. */
START_TEST(test_overlapping_ranges)
{
	struct frame_list list = { 0 };

	ck_assert_int_eq(frame_list_parse("1-5555500000000065,88,80-90,5555500000000060-5555500000000070", &list), 0);
	ck_assert_uint_eq(frame_list_count(&list, UINT64_MAX), 5555500000000070);
	ck_assert_uint_eq(frame_list_part_of(&list, UINT64_MAX, 5555500000000070, 1000), 1000);
	frame_list_free(&list);
	ck_assert_str_eq(frames_of("0-2,2-4,4,1,7-8x3", 10), "0 1 2 3 4 7");
	ck_assert_int_eq(frame_list_parse("0-4000000000x2,0-4000000000x3", &list), ERR_USAGE);
	ck_assert_int_eq(frame_list_parse("0-18446744073709551615x2,5-18446744073709551615", &list), ERR_USAGE);
	ck_assert_ptr_null(list.ranges);
}
END_TEST

/* A frame's part is the one that contains it. */
START_TEST(test_parts_of_frames)
{
	static const char *const texts[] = { "3-40", "0-30x3,40-60", "1-6,2-8x2,8", "5,7" };

	for (size_t t = 0; t < sizeof(texts) / sizeof(texts[0]); t++)
		for (uint64_t n = 1; n < 9; n++)
			for (uint64_t i = 1; i <= n; i++) {
				struct frame_list whole = { 0 }, part = { 0 };
				uint64_t frame = 0;

				ck_assert(!frame_list_parse(texts[t], &whole) && !frame_list_parse(texts[t], &part));
				if (frame_list_chunk(&part, UINT64_MAX, i, n) == 0)
					for (; frame_list_next(&part, frame, &frame); frame++)
						ck_assert_uint_eq(frame_list_part_of(&whole, UINT64_MAX, frame, n), i);
				frame_list_free(&whole);
				frame_list_free(&part);
			}
}
END_TEST

static const char *expanded(const char *pattern, uint64_t frame)
{
	static char out[64];

	ck_assert_int_eq(frame_pattern_expand(pattern, frame, out, sizeof(out)), 0);
	return out;
}

START_TEST(test_patterns)
{
	ck_assert_str_eq(expanded("a.####.exr", 12), "a.0012.exr");
	ck_assert_str_eq(expanded("a.#.exr", 12), "a.12.exr");
	ck_assert_str_eq(expanded("a.%04d.exr", 12), "a.0012.exr");
	ck_assert_str_eq(expanded("a.%d.exr", 12), "a.12.exr");
	ck_assert_str_eq(expanded("a.$F4.exr", 12), "a.0012.exr");
	ck_assert_str_eq(expanded("a.$F.exr", 12), "a.12.exr");
	ck_assert_str_eq(expanded("a.{frame}.exr", 12), "a.12.exr");
	ck_assert_str_eq(expanded("a.##.exr", 12345), "a.12345.exr");
	ck_assert_str_eq(expanded("100%/a.###.exr", 1), "100%/a.001.exr");
	ck_assert_int_eq(frame_pattern_has_number("a.%s.exr"), 0);
	ck_assert_int_eq(frame_pattern_has_number("a.%999999999d.exr"), 0);
	ck_assert_int_eq(frame_pattern_has_number("a.%-4d.exr"), 0);
	ck_assert_int_eq(frame_pattern_has_number("a.$G.exr"), 0);
	ck_assert_str_eq(expanded("a.%s%n.exr", 1), "a.%s%n.exr");
}
END_TEST

START_TEST(test_pattern_too_long)
{
	char out[8];

	ck_assert_int_eq(frame_pattern_expand("a.####.exr", 1, out, sizeof(out)), ERR_USAGE);
	ck_assert_int_eq(frame_pattern_expand("%99d", 1, out, sizeof(out)), ERR_USAGE);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("frames");

	tcase_add_test(tcase, test_ranges);
	tcase_add_test(tcase, test_not_ranges);
	tcase_add_test(tcase, test_open_ranges);
	tcase_add_test(tcase, test_chunks);
	tcase_add_test(tcase, test_last_and_count);
	tcase_add_test(tcase, test_overlapping_ranges);
	tcase_add_test(tcase, test_parts_of_frames);
	tcase_add_test(tcase, test_patterns);
	tcase_add_test(tcase, test_pattern_too_long);
	return run_case(tcase, "frames");
}
