/* What relume diff prints of scores: the table and its last line, the summary as Markdown (diff/report). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "diff/report/markdown.h"
#include "diff/report/output.h"
#include "tests/case.h"

enum { MOST = 64 };

static struct score scores[MOST];

/* So many frames from 10 on, passed, with gates of which only V was measured. */
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

	output_table(run, out);
	ck_assert_int_eq(fclose(out), 0);
	return text;
}

static void check_says(const char *text, const char *wanted, int often)
{
	int n = 0;

	for (const char *at = text; (at = strstr(at, wanted)); at++)
		n++;
	ck_assert_msg(n == often, "\"%s\" is there %d times, not %d, in:\n%s", wanted, n, often, text);
}

/* The last line: how many frames, the worst of those that were compared, the first that is wrong. */
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
	check_says(text, "\n4 frames: 1 passed, 2 failed, 1 missing; lowest fidelity 70.000 % (frame 12); first wrong frame 10\n", 1);
	free(text);
	run = run_of(0);
	text = table_of(&run);
	check_says(text, "\n0 frames: 0 passed\n", 1);
	free(text);
}
END_TEST

/* What failed comes first, frames in a row that failed alike in one row; those that passed have a row each. */
START_TEST(test_rows)
{
	struct output_run run = run_of(8);
	char *text;

	for (size_t i = 2; i < 6; i++)
		fail_frame(&run, i, i == 4 ? 9 : 8); /* 12, 13 and 15 alike, 14 otherwise */
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

/* Gates that were not measured are named once, by the first frame that was compared and is valid. */
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

/* Twenty rows at most, and how many more frames there are; frames in a row that failed the same gates are one row. */
START_TEST(test_markdown)
{
	struct output_run run = run_of(40);
	char *text = markdown_of(&run);

	check_says(text, "### relume diff: a\n\n40 passed of 40 frames; [page](page/index.html), [contact sheet](page/sheet.png)\n", 1);
	check_says(text, "| frames |", 0);
	free(text);
	for (size_t i = 3; i < 23; i++)
		fail_frame(&run, i, i == 9 ? 12 : 8);
	text = markdown_of(&run);
	check_says(text, "| frames | outcome |", 1);
	check_says(text, "\n| 13-32 | failed | not as the program showed it: **R3** pixels over 32/255 12 px (bar \\<= 4 px) (frame 19, the worst) |  |\n", 1);
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
	check_says(text, "(bar \\<= 4 px)<br>not as approved: **B** pixels off from the approved frame 5 % (bar \\<= 0.01 %)", 1);
	free(text);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("output");

	tcase_add_test(tcase, test_last_line);
	tcase_add_test(tcase, test_rows);
	tcase_add_test(tcase, test_not_measured);
	tcase_add_test(tcase, test_markdown);
	return run_case(tcase, "output");
}
