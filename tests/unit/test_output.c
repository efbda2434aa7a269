/* Score output of relume diff: the table and its last line, the summary, Markdown, JUnit XML (diff/report). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "diff/report/markdown.h"
#include "diff/report/junit.h"
#include "diff/report/output.h"
#include "diff/report/summary.h"
#include "diff/report/table.h"
#include "tests/alone.h"

enum { MOST = 64 };

static struct score scores[MOST];

/* n passed frames, from number 10 on, of whose gates only V was measured. */
static struct output_run run_of(size_t n)
{
	struct output_run run = { .reference = "a.ref", .traced = "out", .name = "a", .scores = scores, .n_scores = n };

	memset(scores, 0, sizeof(scores));
	for (size_t i = 0; i < n; i++) {
		scores[i].frame = 10 + i;
		scores[i].outcome = SCORE_FRAME_PASSED;
		scores[i].fidelity = 1;
		scores[i].info.beauty_flip = NAN;
		scores[i].gates[GATE_V].state = SCORE_PASSED;
	}
	run.counts[SCORE_FRAME_PASSED] = n;
	return run;
}

static void fail_frame(struct output_run *run, size_t i, double px)
{
	struct score *s = &run->scores[i];

	s->outcome = SCORE_FRAME_FAILED;
	s->fidelity = 1 - px / 100;
	s->gates[GATE_R3].state = SCORE_FAILED;
	s->gates[GATE_R3].value[0] = px;
	s->gates[GATE_R3].bar[0] = 4;
	run->counts[SCORE_FRAME_PASSED]--;
	run->counts[SCORE_FRAME_FAILED]++;
}

static char *table_of(const struct output_run *run)
{
	size_t size;
	char *text = NULL;
	FILE *out = open_memstream(&text, &size);

	table_write(run, out);
	ck_assert_int_eq(fclose(out), 0);
	return text;
}

static void check_says(const char *text, const char *wanted, int often)
{
	int n = 0;

	for (const char *at = text; (at = strstr(at, wanted)); at++)
		n++;
	ck_assert_msg(n == often, "\"%s\" occurs %d times, expected %d, in:\n%s", wanted, n, often, text);
}

/* The last line: number of frames, the worst of those compared, the first wrong one. */
START_TEST(test_last_line)
{
	struct output_run run = run_of(1);
	char *text = table_of(&run);

	check_says(text, "\n1 frame: 1 passed; lowest fidelity 100.000 % (frame 10)\n", 1);
	free(text);
	run = run_of(4);
	fail_frame(&run, 2, 30);
	fail_frame(&run, 3, 7);
	scores[0].outcome = SCORE_FRAME_MISSING;
	run.counts[SCORE_FRAME_PASSED] = 1;
	run.counts[SCORE_FRAME_MISSING] = 1;
	text = table_of(&run);
	check_says(text,
	           "\n4 frames: 1 passed, 2 failed, 1 missing; lowest fidelity 70.000 % (frame 12); first wrong frame "
	           "10\n",
	           1);
	free(text);
	run = run_of(0);
	text = table_of(&run);
	check_says(text, "\n0 frames: 0 passed\n", 1);
	free(text);
}
END_TEST

/* Failures come first; consecutive frames with the same failure share a row; passed frames have a row each. */
START_TEST(test_rows)
{
	struct output_run run = run_of(8);
	char *text;

	for (size_t i = 2; i < 6; i++)
		fail_frame(&run, i, i == 4 ? 9 : 8); /* 12, 13 and 15 are alike, 14 differs */
	text = table_of(&run);
	check_says(text, "  12-13 failed", 1);
	check_says(text, "     14 failed", 1);
	check_says(text, "     15 failed", 1);
	check_says(text, "     16 passed", 1);
	check_says(text, "     17 passed", 1);
	check_says(text, "R3  gross errors: pixels over 32/255 8 px (bar <= 4 px)", 2);
	ck_assert(strstr(text, "10 passed") > strstr(text, "15 failed"));
	free(text);
}
END_TEST

/* Unmeasured gates are listed once, from the first frame that was compared and is valid. */
START_TEST(test_not_measured)
{
	struct output_run run = run_of(3);
	char *text;

	scores[0].outcome = SCORE_FRAME_MISSING;
	scores[1].gates[GATE_V].state = SCORE_FAILED;
	scores[1].gates[GATE_V].note[0] = '\0';
	for (int g = 1; g < N_GATES; g++)
		for (size_t i = 0; i < 3; i++)
			snprintf(scores[i].gates[g].note, sizeof(scores[i].gates[g].note), "reason %zu of %d", i, g);
	text = table_of(&run);
	check_says(text, "not measured: ", N_GATES - 1);
	check_says(text, "not measured: R1 interior colour: reason 2 of 1\n", 1);
	check_says(text, "not measured: B baseline: reason 2 of", 1);
	free(text);
}
END_TEST

static char *summary_of(const struct output_run *run, const char *report)
{
	size_t size;
	char *text = NULL;
	FILE *out = open_memstream(&text, &size);

	ck_assert_int_eq(summary_write(run, report, out), 0);
	ck_assert_int_eq(fclose(out), 0);
	return text;
}

/* 100 columns: failures, grouped by kind, the failed comparison, and advice; passed frames are not mentioned. */
START_TEST(test_summary)
{
	struct output_run run = run_of(30);
	char *text = summary_of(&run, NULL);

	ck_assert_str_eq(text, "30 frames: 30 passed; lowest fidelity 100.000 % (frame 10)\n");
	free(text);
	for (size_t i = 2; i < 6; i++)
		fail_frame(&run, i, i == 4 ? 9 : 8);
	scores[4].gates[GATE_B].state = SCORE_FAILED;
	scores[4].gates[GATE_B].value[0] = 3;
	memset(scores[4].gates[GATE_B].note, 'w', 130);
	memcpy(scores[4].gates[GATE_B].note + 40, " and ", 5);
	scores[20].outcome = SCORE_FRAME_EXTRA;
	run.counts[SCORE_FRAME_EXTRA]++;
	run.counts[SCORE_FRAME_PASSED]--;
	run.baseline = "approved";
	text = summary_of(&run, NULL);
	check_says(text,
	           "frames 12-13: failed, fidelity 92.000 % in the worst, frame 12\n  not as the reference\n    R3 "
	           "gross errors: pixels over 32/255 8 px (bar <= 4 px)\n",
	           1);
	check_says(text, "frame 14: failed, fidelity 91.000 %\n  not as the reference\n    R3 ", 1);
	check_says(text, "  not as approved\n    B baseline: pixels off from the approved frame 3 %", 1);
	check_says(text, "frame 30: extra: there is no reference for it\n", 1);
	check_says(text, "Look at them: once more with --report DIR", 1);
	check_says(text, "If they are right: relume approve -f 14 out approved\n", 1);
	check_says(text,
	           "\n30 frames: 25 passed, 4 failed, 1 extra; lowest fidelity 91.000 % (frame 14); first wrong frame "
	           "12\n",
	           1);
	for (const char *line = text; *line; line += strcspn(line, "\n") + 1)
		ck_assert_msg(strcspn(line, "\n") <= 100, "more than 100 columns: %.*s", (int)strcspn(line, "\n"), line);
	free(text);
	text = summary_of(&run, "page");
	check_says(text, "Look at them: page/index.html\n", 1);
	free(text);
	run = run_of(60);
	for (size_t i = 0; i < 60; i += 2)
		fail_frame(&run, i, 8);
	text = summary_of(&run, NULL);
	check_says(text, "\nand 18 more frames (--table shows all)\n", 1);
	free(text);
}
END_TEST

static char *junit_of(const struct output_run *run)
{
	char path[] = "/tmp/relume-test-output-XXXXXX", *text = calloc(1, 1 << 16);
	FILE *in;

	close(mkstemp(path));
	ck_assert_int_eq(junit_write(run, path), 0);
	in = fopen(path, "r");
	ck_assert(fread(text, 1, (1 << 16) - 1, in) > 0);
	fclose(in);
	unlink(path);
	return text;
}

/* A case names the recording, frame, picture and reference, and describes which comparison failed. */
START_TEST(test_junit)
{
	struct set_entry entries[2][3] = { { { .frame = 10, .path = "ref/a.10.png" },
		                             { .frame = 11, .path = "ref/a.11.png" },
		                             { .frame = 12, .path = "ref/log<in.png", .name = "log<in" } },
		                           { { .frame = 10, .path = "out/a.10.png" },
		                             { .frame = 11, .path = "out/a.11.png" },
		                             { .frame = 12, .path = "out/log<in.png", .name = "log<in" } } };
	const struct set ref = { .entries = entries[0], .n_entries = 3 }, set = { .entries = entries[1], .n_entries = 3 };
	struct output_run run = run_of(4);
	char *text;

	run.ref = &ref;
	run.set = &set;
	fail_frame(&run, 1, 8);
	fail_frame(&run, 2, 9);
	scores[3].outcome = SCORE_FRAME_MISSING;
	run.counts[SCORE_FRAME_PASSED]--;
	run.counts[SCORE_FRAME_MISSING]++;
	text = junit_of(&run);
	check_says(text, "<testsuite name=\"relume diff a\" tests=\"4\" failures=\"3\" errors=\"0\" skipped=\"0\"", 1);
	check_says(text, "<property name=\"reference\" value=\"a.ref\"/>", 1);
	check_says(text, "<testcase classname=\"a\" name=\"frame 10\" file=\"out/a.10.png\"/>", 1);
	check_says(text, "<testcase classname=\"a\" name=\"log&lt;in\" file=\"out/log&lt;in.png\">", 1);
	check_says(
		text,
		"<failure message=\"not as the reference: R3 gross errors: pixels over 32/255 8 px (bar &lt;= 4 px)\">",
		1);
	check_says(text, "\nrecording: a\npicture: out/a.11.png\nreference: ref/a.11.png\n</failure>", 1);
	check_says(text,
	           "<testcase classname=\"a\" name=\"frame 13\">\n      <failure message=\"there is no picture to "
	           "compare\">",
	           1);
	free(text);
}
END_TEST

static char *markdown_of(const struct output_run *run)
{
	char path[] = "/tmp/relume-test-output-XXXXXX", *text = calloc(1, 1 << 16);
	FILE *in;

	close(mkstemp(path));
	ck_assert_int_eq(markdown_write(run, "page", path), 0);
	in = fopen(path, "r");
	ck_assert(fread(text, 1, (1 << 16) - 1, in) > 0);
	fclose(in);
	unlink(path);
	return text;
}

/* At most twenty rows, and the number of further frames; consecutive frames that failed the same gates share a row. */
START_TEST(test_markdown)
{
	struct output_run run = run_of(40);
	char *text = markdown_of(&run);

	check_says(text,
	           "### relume diff: a\n\n40 passed of 40 frames; [page](page/index.html), [contact "
	           "sheet](page/sheet.png)\n",
	           1);
	check_says(text, "| frames |", 0);
	free(text);
	for (size_t i = 3; i < 23; i++)
		fail_frame(&run, i, i == 9 ? 12 : 8);
	text = markdown_of(&run);
	check_says(text, "| frames | outcome |", 1);
	check_says(text,
	           "\n| 13-32 | failed | not as the reference: **R3** pixels over 32/255 12 px (bar \\<= 4 px) (frame "
	           "19, the worst) |  |\n",
	           1);
	check_says(text, "more", 0);
	free(text);
	run = run_of(60);
	for (size_t i = 0; i < 46; i += 2)
		fail_frame(&run, i, 8);
	text = markdown_of(&run);
	check_says(text, "| failed |", 20);
	check_says(text, "\nand 3 more\n", 1);
	free(text);
	run = run_of(2);
	run.baseline = "approved";
	fail_frame(&run, 0, 8);
	scores[0].gates[GATE_B].state = SCORE_FAILED;
	scores[0].gates[GATE_B].bar[0] = 0.01;
	scores[0].gates[GATE_B].value[0] = 5;
	text = markdown_of(&run);
	check_says(text, "[approved, now and difference](page/sheet.png)", 1);
	check_says(text,
	           "(bar \\<= 4 px)<br>not as approved: **B** pixels off from the approved frame 5 % (bar \\<= 0.01 %)",
	           1);
	free(text);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("output");

	tcase_add_test(tcase, test_last_line);
	tcase_add_test(tcase, test_rows);
	tcase_add_test(tcase, test_not_measured);
	tcase_add_test(tcase, test_summary);
	tcase_add_test(tcase, test_junit);
	tcase_add_test(tcase, test_markdown);
	return run_alone(tcase, "output");
}
