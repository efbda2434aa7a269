/* Command lines parsed by table: values are stored, wrong ones are refused, and help lists every option. */
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/options.h"
#include "tests/case.h"

static const char *const colors[] = { "red", "green", NULL };

struct asked {
	const char *output, *kind;
	int color, flag;
	unsigned number;
	uint64_t bytes;
	struct frame_list frames;
};

static const struct options_row rows[] = {
	{ .help = "What:" },
	{ "output", 'o', "FILE", "where to", options_text, .at = offsetof(struct asked, output), .is_required = 1 },
	{ "color", 0, "WORD", "red or green", options_word, .at = offsetof(struct asked, color), .words = colors },
	{ "kind", 0, "WORD", "red or green, as text", options_text, .at = offsetof(struct asked, kind),
	  .words = colors },
	{ "flag", 'x', NULL,
	  "a flag whose explanation is so long that it does not fit into one line of a hundred and fourteen columns, "
	  "and has to go on below",
	  options_flag, .at = offsetof(struct asked, flag) },
	{ "no-flag", 0, NULL, "the opposite", options_clear, .at = offsetof(struct asked, flag) },
	{ "number", 'n', "N", "up to 9", options_number, .at = offsetof(struct asked, number), .most = 9 },
	{ "a-name-that-is-very-long", 0, "M", "bytes", options_bytes, .at = offsetof(struct asked, bytes) },
	{ "frames", 'f', "LIST", "frames", options_frames, .at = offsetof(struct asked, frames) },
};

static struct options_table table = {
	.verb = "paint",
	.head = "usage: relume paint TRACE\n",
	.rows = rows,
	.n_rows = sizeof(rows) / sizeof(rows[0]),
	.notes = "Notes.\n",
	.takes = "one trace and -o FILE",
	.least = 1,
	.most = 1,
};

/* Words separated by spaces. */
static int parse(const char *words, struct asked *out, struct options_line *line)
{
	static char text[256], *argv[32];
	int argc = 0;

	snprintf(text, sizeof(text), "paint %s", words);
	for (char *p = strtok(text, " "); p; p = strtok(NULL, " "))
		argv[argc++] = p;
	argv[argc] = NULL;
	*out = (struct asked){ .color = -1 };
	return options_parse(&table, argc, argv, out, line);
}

START_TEST(values_arrive)
{
	struct options_line line;
	struct asked a;

	ck_assert_int_eq(parse("-o x --color green in.trace -xn 7 --kind=red --a-name 2K -f 1-3", &a, &line), 0);
	ck_assert_str_eq(a.output, "x");
	ck_assert_str_eq(a.kind, "red");
	ck_assert_int_eq(a.color, 1);
	ck_assert_int_eq(a.flag, 1);
	ck_assert_uint_eq(a.number, 7);
	ck_assert_uint_eq(a.bytes, 2048);
	ck_assert_uint_eq(frame_list_last(&a.frames), 3);
	ck_assert_int_eq(line.n_words, 1);
	ck_assert_str_eq(line.words[0], "in.trace");
	ck_assert_str_eq(line.given[2], "green");
	ck_assert_str_eq(line.given[4], "");
	ck_assert_ptr_null(line.given[5]);
	frame_list_free(&a.frames);
	ck_assert_int_eq(parse("-x -o x t --no-flag -o y", &a, &line), 0);
	ck_assert_int_eq(a.flag, 0);
	ck_assert_str_eq(line.given[1], "y");
}
END_TEST

START_TEST(wrong_usage_is_refused)
{
	static const char *const wrong[] = {
		"", "t", "-o x", "-o x t u", "-o x t --none", "-o x t -n 10", "-o x t -n -1", "-o x t -n 1x", "-o x t --color blue",
		"-o x t --kind blue", "-o x t --a-name 0", "-o x t --a-name 2X", "-o x t --a-name 2KK", "-o x t -f 3-1",
		"-o x t --color", "-o x t --flag=1",
	};
	struct options_line line;
	struct asked a;

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		ck_assert_msg(parse(wrong[i], &a, &line) == ERR_USAGE, "%s", wrong[i]);
		frame_list_free(&a.frames);
	}
}
END_TEST

START_TEST(another_programs_options_are_left_alone)
{
	struct options_line line;
	struct asked a;

	table.stops = 1;
	table.most = -1;
	ck_assert_int_eq(parse("-o x program -n 100 --flag", &a, &line), 0);
	ck_assert_int_eq(line.n_words, 4);
	ck_assert_int_eq(a.flag, 0);
	ck_assert_int_eq(parse("-o x -- -n", &a, &line), 0);
	ck_assert_str_eq(line.words[0], "-n");
}
END_TEST

START_TEST(help_says_all)
{
	char *text;
	size_t bytes;
	FILE *out = open_memstream(&text, &bytes);

	options_print_help(&table, out);
	fclose(out);
	ck_assert_str_eq(text, "usage: relume paint TRACE\n"
	                       "\n"
	                       "What:\n"
	                       "  -o, --output FILE  where to\n"
	                       "      --color WORD   red or green\n"
	                       "      --kind WORD    red or green, as text\n"
	                       "  -x, --flag         a flag whose explanation is so long that it does not fit into one "
	                       "line of a hundred and\n"
	                       "                     fourteen columns, and has to go on below\n"
	                       "      --no-flag      the opposite\n"
	                       "  -n, --number N     up to 9\n"
	                       "      --a-name-that-is-very-long M  bytes\n"
	                       "  -f, --frames LIST  frames\n"
	                       "  -h, --help         this text\n"
	                       "\n"
	                       "Notes.\n");
	free(text);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("options");

	tcase_add_test(tcase, values_arrive);
	tcase_add_test(tcase, wrong_usage_is_refused);
	tcase_add_test(tcase, another_programs_options_are_left_alone);
	tcase_add_test(tcase, help_says_all);
	return run_case(tcase, "options");
}
