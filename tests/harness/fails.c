/* Tests that must fail, each in its own way; tests/harness/test_must_fail.py checks that the runner notices. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/case.h"

START_TEST(test_pass)
{
	ck_assert_int_eq(1, 1);
}
END_TEST

START_TEST(test_fail)
{
	ck_assert_int_eq(1, 2);
}
END_TEST

START_TEST(test_crash)
{
	volatile int *volatile nowhere = NULL;

	*nowhere = 1;
}
END_TEST

START_TEST(test_exit)
{
	exit(3);
}
END_TEST

START_TEST(test_hang)
{
	for (;;)
		pause();
}
END_TEST

START_TEST(test_leak)
{
	void *volatile lost = malloc(17);

	memset(lost, 1, 17);
	lost = NULL;
}
END_TEST

int main(int argc, char **argv)
{
	const struct { const char *name; const TTest *test; } tests[] = {
		{ "pass", test_pass }, { "fail", test_fail }, { "crash", test_crash },
		{ "exit", test_exit }, { "hang", test_hang }, { "leak", test_leak },
	};
	TCase *tcase = tcase_create("all");

	tcase_set_timeout(tcase, 1);
	for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]); i++)
		if (argc > 1 && strcmp(argv[1], tests[i].name) == 0)
			tcase_add_test(tcase, tests[i].test);
	return run_case(tcase, "must fail");
}
