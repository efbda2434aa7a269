/* Pictures read by a separate process must equal those read in this one, whatever happens to that process. */
#include <dirent.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "tests/emulated.h"
#include "tests/alone.h"
#include "tracer/image/display.h"
#include "tracer/image/foreign.h"
#include "tracer/image/oiio.h"

#define WIDTH 61u
#define HEIGHT 37u

static char folder[] = "/tmp/test_foreign.XXXXXX";

static const char *path_of(const char *name)
{
	static _Thread_local char path[64];

	snprintf(path, sizeof(path), "%s/%s", folder, name);
	return path;
}

static void setup(void)
{
	uint8_t rgb[WIDTH * HEIGHT * 3];
	const struct oiio_pixels pixels = { rgb, WIDTH, HEIGHT };

	strcpy(folder, "/tmp/test_foreign.XXXXXX");
	ck_assert_ptr_nonnull(mkdtemp(folder));
	for (unsigned i = 0; i < sizeof(rgb); i++)
		rgb[i] = (uint8_t)(i * 7u ^ i >> 5);
	ck_assert_int_eq(display_save(&pixels, &(struct oiio_coding){ "png", .level = 1, .text = "relume:frame 12\n" },
	                              path_of("good.png")),
	                 0);
}

static void teardown(void)
{
	unlink(path_of("good.png"));
	unlink(path_of("slow.png"));
	unlink(path_of("bad.png"));
	rmdir(folder);
}

/* A child process of `parent`, or 0. */
static pid_t child_of(pid_t parent)
{
	DIR *all = opendir("/proc");
	pid_t found = 0;

	for (struct dirent *entry; !found && (entry = readdir(all));) {
		char path[300];
		int child, of;
		FILE *file;

		snprintf(path, sizeof(path), "/proc/%s/stat", entry->d_name);
		file = fopen(path, "r");
		if (file && fscanf(file, "%d (%*[^)]) %*c %d", &child, &of) == 2 && of == parent)
			found = child;
		if (file)
			fclose(file);
	}
	closedir(all);
	return found;
}

static void check_good(void)
{
	struct image here = { 0 }, apart = { 0 };

	ck_assert_int_eq(foreign_read(&apart, path_of("good.png")), 0);
	ck_assert_int_eq(oiio_read(&here, path_of("good.png")), 0);
	ck_assert_uint_eq(apart.width, WIDTH);
	ck_assert_uint_eq(apart.height, HEIGHT);
	ck_assert_uint_eq(apart.n_channels, here.n_channels);
	for (size_t i = 0; i < here.n_channels; i++) {
		ck_assert_str_eq(apart.channels[i].name, here.channels[i].name);
		ck_assert_int_eq(apart.channels[i].full_float, here.channels[i].full_float);
		ck_assert_mem_eq(apart.channels[i].values, here.channels[i].values, WIDTH * HEIGHT * sizeof(float));
	}
	ck_assert_uint_eq(apart.n_attributes, here.n_attributes);
	for (size_t i = 0; i < here.n_attributes; i++)
		ck_assert_str_eq(image_attribute(&apart, here.attributes[i].name), here.attributes[i].text);
	ck_assert_str_eq(image_attribute(&apart, "relume:frame"), "12");
	image_free(&here);
	image_free(&apart);
}

START_TEST(as_here)
{
	check_good();
	check_good();
}
END_TEST

/* Reading a pipe never ends, so its reader can be killed meanwhile. */
static void *read_slow(void *code)
{
	struct image img = { 0 };
	const int err = foreign_read(&img, path_of("slow.png"));

	ck_assert_ptr_null(img.channels);
	__atomic_store_n((int *)code, err, __ATOMIC_RELEASE);
	return NULL;
}

START_TEST(reader_ended)
{
	pthread_t thread;
	int code = 1;

	check_good();
	ck_assert_int_eq(mkfifo(path_of("slow.png"), 0600), 0);
	ck_assert_int_eq(pthread_create(&thread, NULL, read_slow, &code), 0);
	/* the first one found may still be exiting after the previous picture */
	while (__atomic_load_n(&code, __ATOMIC_ACQUIRE) > 0) {
		const pid_t reader = child_of(child_of(getpid()));

		if (reader)
			kill(reader, SIGSEGV);
		usleep(1000);
	}
	pthread_join(thread, NULL);
	ck_assert_int_eq(code, ERR_INPUT);
	check_good();
}
END_TEST

START_TEST(server_ended)
{
	pid_t server;

	check_good();
	server = child_of(getpid());
	kill(server, SIGKILL);
	waitpid(server, NULL, 0);
	check_good();
}
END_TEST

/* Read in a new run of this program, see main. most_bytes: memory limit @return its status, as from waitpid */
static int read_anew(const char *path, rlim_t most_bytes)
{
	const pid_t process = fork();
	int status;

	if (process == 0 && setrlimit(RLIMIT_AS, &(struct rlimit){ most_bytes, most_bytes }) == 0)
		_exit(execl("/proc/self/exe", "test_foreign", path, NULL));
	return waitpid(process, &status, 0) == process ? status : -1;
}

/* The TIFF reader takes the locks of these threads: none may be held when the server starts. */
START_TEST(started_often)
{
	char command[200];

	snprintf(command, sizeof(command), "oiiotool %s/good.png --compression zip -o %s/strips.tif", folder, folder);
	ck_assert_int_eq(system(command), 0);
	for (int i = 0; i < 30; i++)
		ck_assert_int_eq(read_anew(path_of("strips.tif"), RLIM_INFINITY), 0);
	unlink(path_of("strips.tif"));
}
END_TEST

/* Write a size of 16383 x 16383 into the header of a baseline JPEG (ITU T.81 B.2.2). @return whether it has one */
static int claim_much(const char *path)
{
	FILE *file = fopen(path, "r+b");
	int last = 0, c;

	while ((c = fgetc(file)) != EOF && !(last == 0xff && c == 0xc0))
		last = c;
	if (c != EOF && fseek(file, 3, SEEK_CUR) == 0)
		fwrite("\x3f\xff\x3f\xff", 1, 4, file);
	fclose(file);
	return c != EOF;
}

/* A picture too large for memory does not end the server: others are read. */
START_TEST(claims_too_much)
{
	char command[200];

	if (memory_is_emulated())
		return;
	snprintf(command, sizeof(command), "oiiotool %s/good.png -o %s/large.jpg", folder, folder);
	ck_assert_int_eq(system(command), 0);
	ck_assert(claim_much(path_of("large.jpg")));
	ck_assert_int_eq(read_anew(path_of("large.jpg"), (rlim_t)2 << 30), -ERR_INPUT << 8);
	unlink(path_of("large.jpg"));
}
END_TEST

START_TEST(not_a_picture)
{
	struct image img = { 0 };
	FILE *file = fopen(path_of("bad.png"), "wb");

	fputs("no picture", file);
	fclose(file);
	ck_assert_int_eq(foreign_read(&img, path_of("bad.png")), ERR_INPUT);
	ck_assert_ptr_null(img.channels);
	ck_assert_int_eq(foreign_read(&img, path_of("missing.png")), ERR_INPUT);
	check_good();
}
END_TEST

static void *read_many(void *count)
{
	struct image img = { 0 };

	for (intptr_t i = 0; i < (intptr_t)count; i++) {
		ck_assert_int_eq(foreign_read(&img, path_of("good.png")), 0);
		image_free(&img);
	}
	return NULL;
}

/* Threads start and end, including the one that started the server. */
START_TEST(many_at_once)
{
	const pid_t before = child_of(getpid());
	pthread_t threads[8];

	if (before) {
		kill(before, SIGKILL);
		waitpid(before, NULL, 0);
	}
	for (int round = 0; round < 3; round++) {
		for (int i = 0; i < 8; i++)
			ck_assert_int_eq(pthread_create(&threads[i], NULL, read_many, (void *)(intptr_t)(i + 1)), 0);
		for (int i = 0; i < 8; i++)
			pthread_join(threads[i], NULL);
	}
}
END_TEST

int main(int argc, char **argv)
{
	TCase *tests = tcase_create("foreign");
	struct image img = { 0 };

	if (argc > 1) {
		alarm(10);
		return -foreign_read(&img, argv[1]);
	}

	tcase_add_checked_fixture(tests, setup, teardown);
	tcase_add_test(tests, as_here);
	tcase_add_test(tests, reader_ended);
	tcase_add_test(tests, server_ended);
	tcase_add_test(tests, started_often);
	tcase_add_test(tests, claims_too_much);
	tcase_add_test(tests, not_a_picture);
	tcase_add_test(tests, many_at_once);
	return run_alone(tests, "foreign");
}
