/* base/folder: making folders for output. */
#include "base/folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
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
	static const char *const made[] = { "a/b/c", "a/b", "a", "d" };

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

int main(void)
{
	TCase *tcase = tcase_create("folder");

	tcase_add_checked_fixture(tcase, setup, teardown);
	tcase_add_test(tcase, test_make);
	tcase_add_test(tcase, test_in_the_way);
	return run_case(tcase, "folder");
}
