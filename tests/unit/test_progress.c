/*
 * base/progress and base/err: output to standard error that is not a terminal. (The bar: tests/real/test_progress.py.)
 */
#include "base/progress.h"

#include <string.h>

#include "base/err.h"
#include "tests/case.h"
#include "tests/said.h"

static char captured[2048];

/** Redirect standard error to a file while `body` runs; the output is stored in `captured`. */
static void capture_stderr(void (*body)(void))
{
	struct said said;

	fflush(stderr);
	said = said_begin();
	body();
	fflush(stderr);
	said_end(&said, captured, sizeof(captured));
}

static void run_known_total(void)
{
	struct progress p;

	progress_begin(&p, "rendered", 2);
	progress_step(&p, 10, "0.1 s");
	progress_step(&p, 15, "0.2 s");
	progress_end(&p);
}

static void run_unknown_total(void)
{
	struct progress p;

	progress_begin(&p, "scored", 0);
	progress_step(&p, 3, "passed");
	progress_end(&p);
}

static void report_lines(void)
{
	ck_assert_int_eq(err_report(ERR_INPUT, "a.trace: frame 3", "%d bytes are missing", 7), ERR_INPUT);
	ck_assert_int_eq(err_report(ERR_SYSTEM, NULL, "out of memory"), ERR_SYSTEM);
	err_warn("a.trace", "cut short");
}

START_TEST(test_lines)
{
	capture_stderr(run_known_total);
	ck_assert_str_eq(captured, "rendered frame 10, 1 of 2: 0.1 s\nrendered frame 15, 2 of 2: 0.2 s\n");
	capture_stderr(run_unknown_total);
	ck_assert_str_eq(captured, "scored frame 3: passed\n");
}
END_TEST

/* Ten seconds pass between lines; frames of another one start over. */
static void run_replay(void)
{
	struct progress p;

	progress_begin(&p, "rendered", 2);
	progress_replay(&p, 40, 1, 30, "they show");
	p.told_s -= 9;
	progress_replay(&p, 40, 10, 30, "they show");
	p.told_s -= 1.5;
	progress_replay(&p, 40, 11, 30, "they show");
	progress_replay(&p, 40, 12, 30, "they show");
	progress_replay(&p, 50, 1, 9, NULL);
	p.told_s -= 11;
	progress_replay(&p, 50, 2, 9, NULL);
	progress_end(&p);
}

START_TEST(test_replay)
{
	capture_stderr(run_replay);
	ck_assert_str_eq(
		captured,
		"replayed 11 of 30 frames before frame 40: they show\nreplayed 2 of 9 frames before frame 50\n");
}
END_TEST

static void run_samples(void)
{
	struct progress p;

	progress_begin(&p, "rendered", 2);
	progress_sample(&p, 40, 1, 64);
	p.sampled_s -= 9;
	progress_sample(&p, 40, 2, 64);
	p.sampled_s -= 1.5;
	progress_sample(&p, 40, 3, 64);
	progress_sample(&p, 40, 4, 64);
	p.sampled_s -= 11;
	progress_sample(&p, 41, 900, 0);
	progress_end(&p);
}

START_TEST(test_samples)
{
	capture_stderr(run_samples);
	ck_assert_str_eq(captured, "frame 40: sample 3 of 64\nframe 41: sample 900\n");
}
END_TEST

/* Forty seconds of compiling, then ten frames per second. */
static void run_bar(void)
{
	struct progress p;

	progress_begin_style(&p, "rendered", 31, PROGRESS_BAR);
	p.start_s -= 43;
	progress_step(&p, 0, "");
	fputc('\n', stderr);
	progress_step(&p, 1, "");
	fputc('\n', stderr);
	p.first_s -= 2;
	p.done = 20;
	progress_step(&p, 20, "");
	fputc('\n', stderr);
	p.sampled_s = p.first_s;
	progress_sample(&p, 21, 5, 8);
	fputc('\n', stderr);
	p.done = 30;
	progress_step(&p, 30, "");
	progress_end(&p);
}

/* The time left is estimated from the frames after the first, and is not printed before there are any. */
START_TEST(test_time_left)
{
	const char *line = captured;

	capture_stderr(run_bar);
	for (int i = 0; i < 2; i++, line = strchr(line, '\n') + 1)
		ck_assert_msg(memmem(line, (size_t)(strchr(line, '\n') - line), "left", 4) == NULL, "%s", captured);
	ck_assert_msg(strstr(line, "21/31") && strstr(line, "  1 s left\n"), "%s", captured);
	ck_assert_msg(strstr(line, "  1 s left  frame 21: sample 5 of 8\n"), "%s", captured);
	ck_assert_msg(strstr(line, "31/31") && strstr(line, "  0 s left\r"), "%s", captured);
}
END_TEST

START_TEST(test_reports)
{
	capture_stderr(report_lines);
	ck_assert_str_eq(captured, "relume: a.trace: frame 3: 7 bytes are missing\n"
	                           "relume: out of memory\n"
	                           "relume: warning: a.trace: cut short\n");
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("progress");

	tcase_add_test(tcase, test_lines);
	tcase_add_test(tcase, test_replay);
	tcase_add_test(tcase, test_samples);
	tcase_add_test(tcase, test_time_left);
	tcase_add_test(tcase, test_reports);
	return run_case(tcase, "progress");
}
