/** tests/case.h: shared by the mains of all C tests. */
#pragma once

#include <check.h>

/** Runs one or two cases and releases them, with each test in a separate process. Returns main's exit code: 0 if all
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
