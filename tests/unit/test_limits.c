/* A process that reaches a limit ends with exit code 5 and one line, and leaves no partial file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/limits.h"
#include "base/part.h"
#include "tests/case.h"

#define MIB ((size_t)1 << 20)
#define PIECE (MIB * 4)

static void work(size_t bytes, double seconds)
{
	const struct timespec wait = { 0, 10000000 };

	for (size_t i = 0; i < bytes; i += PIECE) {
		char *piece = malloc(PIECE);

		memset(piece, 1, PIECE);
		nanosleep(&wait, NULL);
	}
	while ((double)clock() / CLOCKS_PER_SEC < seconds)
		;
}

/* Run a child under limits; returns its exit code, and stores its message. */
static int run(const struct limits *limits, size_t bytes, double seconds, char said[1024], const char *path)
{
	int ends[2], status;
	ssize_t n, all = 0;
	pid_t child;

	ck_assert_int_eq(pipe(ends), 0);
	child = fork();
	if (child == 0) {
		struct part_file file;

		dup2(ends[1], 2);
		close(ends[1]);
		if (part_open(&file, path))
			_exit(9);
		limits_begin("x.trace", limits);
		work(bytes, seconds);
		_exit(part_close(&file, 0) ? 9 : 0);
	}
	close(ends[1]);
	while ((n = read(ends[0], said + all, (size_t)(1023 - all))) > 0)
		all += n;
	said[all] = '\0';
	close(ends[0]);
	ck_assert_int_eq(waitpid(child, &status, 0), child);
	ck_assert(WIFEXITED(status));
	return WEXITSTATUS(status);
}

static void check_dropped(const char *folder)
{
	ck_assert_msg(rmdir(folder) == 0, "files were left in %s", folder);
}

START_TEST(limits_end_a_process)
{
	const struct limits little = { 64 * MIB, 1000 }, brief = { 4096 * MIB, 0.3 }, enough = { 4096 * MIB, 1000 },
			    timeless = { 4096 * MIB, 0 };
	char folder[] = "/tmp/limits-XXXXXX", path[64], said[1024];

	ck_assert_ptr_nonnull(mkdtemp(folder));
	snprintf(path, sizeof(path), "%s/whole", folder);
	ck_assert_int_eq(run(&little, 400 * MIB, 0, said, path), 5);
	ck_assert_str_eq(said, "relume: x.trace: asks for more than 64 MiB of memory, the limit for a recording of its "
	                       "size; --no-sandbox lifts it\n");
	check_dropped(folder);
	ck_assert_ptr_nonnull(mkdtemp(strcpy(folder, "/tmp/limits-XXXXXX")));
	snprintf(path, sizeof(path), "%s/whole", folder);
	ck_assert_int_eq(run(&brief, 0, 60, said, path), 5);
	ck_assert_ptr_nonnull(strstr(said, "s of processor time"));
	check_dropped(folder);
	ck_assert_ptr_nonnull(mkdtemp(strcpy(folder, "/tmp/limits-XXXXXX")));
	snprintf(path, sizeof(path), "%s/whole", folder);
	ck_assert_int_eq(run(&enough, 100 * MIB, 0.3, said, path), 0);
	ck_assert_int_eq(run(&timeless, 100 * MIB, 0.6, said, path), 0);
	ck_assert_str_eq(said, "");
	ck_assert_int_eq(unlink(path), 0);
	ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

START_TEST(limits_grow_with_the_recording)
{
	const struct limits small = limits_of_reader(0), large = limits_of_reader(100 * MIB), tracer = limits_of_tracer(0);

	ck_assert_uint_eq(small.memory_bytes, 2048 * MIB);
	ck_assert_uint_eq(large.memory_bytes, (2048 + 25600) * MIB);
	ck_assert(small.processor_s == 600 && large.processor_s == 600 + 25600);
	ck_assert_uint_ge(tracer.memory_bytes, 4096 * MIB);
	ck_assert(tracer.processor_s == 0);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("limits");

	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, limits_end_a_process);
	tcase_add_test(tcase, limits_grow_with_the_recording);
	return run_case(tcase, "limits");
}
