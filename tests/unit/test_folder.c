/* base/folder: creating output folders. */
#include "base/folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "tests/case.h"

static char scratch[64];

static void setup(void)
{
	snprintf(scratch, sizeof(scratch), "/tmp/relume_folder.XXXXXX");
	ck_assert_ptr_nonnull(mkdtemp(scratch));
	ck_assert_int_eq(chdir(scratch), 0);
}

static void teardown(void)
{
	static const char *const made[] = { "a/b/c", "a/b", "a", "d", "kept" };

	for (size_t i = 0; i < sizeof(made) / sizeof(made[0]); i++)
		rmdir(made[i]);
	remove("plain");
	ck_assert_int_eq(chdir("/"), 0);
	rmdir(scratch);
}

static int is_folder(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

START_TEST(test_make)
{
	ck_assert_int_eq(folder_make("a/b/c"), 0);
	ck_assert(is_folder("a/b/c"));
	ck_assert_int_eq(folder_make("a/b/c"), 0);
	ck_assert_int_eq(folder_make("a/b/c/"), 0);
	ck_assert_int_eq(folder_make_for("d/file"), 0);
	ck_assert(is_folder("d"));
	ck_assert(!is_folder("d/file"));
	ck_assert_int_eq(folder_make_for("file"), 0);
	ck_assert_int_eq(folder_make_for("/file"), 0);
}
END_TEST

START_TEST(test_in_the_way)
{
	FILE *plain = fopen("plain", "w");

	ck_assert_ptr_nonnull(plain);
	fclose(plain);
	ck_assert_int_eq(folder_make("plain"), ERR_SYSTEM);
	ck_assert_int_eq(folder_make("plain/a"), ERR_SYSTEM);
	ck_assert_int_eq(folder_make_for("plain/file"), ERR_SYSTEM);
}
END_TEST

/* A process that creates a folder early and exits. */
static void make_early(const char *path, int on_success, int code)
{
	const pid_t child = fork();
	int status;

	if (child == 0)
		exit(folder_try_early(path, on_success) ? 100 : code);
	ck_assert_int_eq(waitpid(child, &status, 0), child);
	ck_assert(WIFEXITED(status));
	ck_assert_int_eq(WEXITSTATUS(status), code);
}

START_TEST(test_early)
{
	char whole[128];

	make_early("d", 0, 3);
	ck_assert(!is_folder("d"));
	make_early("a/b/c/", 1, 0);
	ck_assert(!is_folder("a"));
	snprintf(whole, sizeof(whole), "%s/a/b", scratch);
	make_early(whole, 0, 5);
	ck_assert(!is_folder("a"));
	make_early("kept", 0, 0);
	ck_assert(is_folder("kept"));
	make_early("kept", 1, 3); /* it existed before */
	ck_assert(is_folder("kept"));
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("folder");

	tcase_add_checked_fixture(tcase, setup, teardown);
	tcase_add_test(tcase, test_make);
	tcase_add_test(tcase, test_in_the_way);
	tcase_add_test(tcase, test_early);
	return run_case(tcase, "folder");
}
