/** tests/case.h: what the mains of all C tests have in common. */
#pragma once

#include <check.h>

/** Runs one case or two, which it takes, each test in a process of its own. Returns main's exit code: 0 where all
 * passed. */
static inline int run_cases(TCase *first, TCase *second, const char *name)
{
	Suite *suite = suite_create(name);
	SRunner *runner = srunner_create(suite);
	int failed;

	suite_add_tcase(suite, first);
	if (second)
		suite_add_tcase(suite, second);
	srunner_run_all(runner, CK_NORMAL);
	failed = srunner_ntests_failed(runner);
	srunner_free(runner);
	return failed != 0;
}

static inline int run_case(TCase *tests, const char *name)
{
	return run_cases(tests, NULL, name);
}
