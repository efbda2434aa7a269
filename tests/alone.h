/*
 * Mains of tests with OpenImageIO: a library that it uses waits at exit for a thread that a fork lacks, so these tests
 * run in one process. Each may have its own folder.
 */
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/case.h"

static char alone_folder[] = "/tmp/relume_alone.XXXXXX";

/** Like run_case, without forks. */
static inline int run_alone(TCase *tests, const char *name)
{
	Suite *suite = suite_create(name);
	SRunner *runner;
	int failed;

	suite_add_tcase(suite, tests);
	runner = srunner_create(suite);
	srunner_set_fork_status(runner, CK_NOFORK);
	srunner_run_all(runner, CK_NORMAL);
	failed = srunner_ntests_failed(runner);
	srunner_free(runner);
	return failed != 0;
}

/** A fixture: runs each test in an empty folder of its own. */
static inline void alone_enter(void)
{
	char own[] = "XXXXXX";

	ck_assert_int_eq(chdir(alone_folder), 0);
	ck_assert_ptr_nonnull(mkdtemp(own));
	ck_assert_int_eq(chdir(own), 0);
}

/** Like run_alone, for tests that begin with alone_enter; their folders are removed. */
static inline int run_alone_in_folders(TCase *tests, const char *name)
{
	char command[64];
	int failed;

	if (!mkdtemp(alone_folder))
		return 1;
	failed = run_alone(tests, name);
	snprintf(command, sizeof(command), "rm -rf %s", alone_folder);
	return system(command) || failed;
}
