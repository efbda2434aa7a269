/* Devices: properties that a shared one has in common with its parent, profile counts, and caching of compiled
 * kernels. */
#include <dirent.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "kernels/shared.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/device/launch.h"

/* If a second queue used the GPU kernels on a CPU, it would be several times slower without any visible reason. */
START_TEST(test_shared_device_takes_the_same_kernels)
{
	static const char *const choices[] = { "reference", NULL };

	for (int i = 0; i < 2; i++)
		for (enum device_family family = 0; family < N_DEVICE_FAMILIES; family++) {
			struct device *dev = NULL, *other = NULL;

			ck_assert_int_eq(device_open(choices[i], 0, &dev), 0);
			device_choose_family(dev, family);
			ck_assert_int_eq(device_share(dev, &other), 0);
			ck_assert_int_eq(device_family(other), family);
			ck_assert_str_eq(device_name(other), device_name(dev));
			device_close(&other);
			device_close(&dev);
		}
}
END_TEST

START_TEST(test_profile)
{
	struct device *dev = NULL;
	union buffer_uint occluded = { NULL };
	union buffer_float visibility = { NULL };
	union buffer_ray rays = { NULL };
	struct device_profile profile;
	uint32_t flags[4] = { 0, 1, 0, 1 }, n = 4;
	float out[12];

	memset(&profile, 0, sizeof(profile));
	ck_assert_int_eq(device_open("reference", 2, &dev), 0);
	ck_assert_int_eq(launch_reserve(dev, rays, n), 0);
	ck_assert_int_eq(launch_reserve(dev, occluded, n), 0);
	ck_assert_int_eq(launch_reserve(dev, visibility, 3 * n), 0);
	device_set_profile(dev, &profile);
	ck_assert_int_eq(device_write(dev, occluded.buffer, 0, flags, sizeof(flags)), 0);
	ck_assert_int_eq(launch_shadow_sum(dev, n,
	                                   LAUNCH(shadow_sum, .rays = rays, .occluded = occluded, .weight = 0.5f,
	                                          .first = 1, .through = 0, .n = n, .visibility = visibility)),
	                 0);
	device_set_profile(dev, NULL);
	ck_assert_int_eq(device_read(dev, visibility.buffer, 0, out, sizeof(out)), 0);
	ck_assert_float_eq(out[0], 0.5f);
	ck_assert_float_eq(out[3], 0);
	ck_assert_uint_eq(profile.writes.count, 1);
	ck_assert_uint_eq(profile.writes.amount, sizeof(flags));
	ck_assert_uint_eq(profile.kernels[KERNEL_shadow_sum].count, 1);
	ck_assert_uint_eq(profile.kernels[KERNEL_shadow_sum].amount, n);
	ck_assert(profile.kernels[KERNEL_shadow_sum].wall_s > 0);
	ck_assert_uint_eq(profile.reads.count, 0);
	ck_assert_str_eq(kernel_entries[KERNEL_shadow_sum].name, "shadow_sum");
	device_release(dev, &rays.buffer);
	device_release(dev, &occluded.buffer);
	device_release(dev, &visibility.buffer);
	device_close(&dev);
}
END_TEST

/* Sum two lights' shadows. */
static void run_kernel(struct device *dev)
{
	const uint32_t flags[2] = { 0, 1 }, n = 2;
	union buffer_uint occluded = { NULL };
	union buffer_float visibility = { NULL };
	union buffer_ray rays = { NULL };
	float out[6];

	ck_assert_int_eq(launch_upload(dev, occluded, flags, n), 0);
	ck_assert_int_eq(launch_reserve(dev, rays, n), 0);
	ck_assert_int_eq(launch_reserve(dev, visibility, 3 * n), 0);
	ck_assert_int_eq(launch_shadow_sum(dev, n,
	                                   LAUNCH(shadow_sum, .rays = rays, .occluded = occluded, .weight = 0.25f,
	                                          .first = 1, .through = 0, .n = n, .visibility = visibility)),
	                 0);
	ck_assert_int_eq(device_read(dev, visibility.buffer, 0, out, sizeof(out)), 0);
	ck_assert_float_eq(out[0], 0.25f);
	ck_assert_float_eq(out[3], 0);
	device_release(dev, &rays.buffer);
	device_release(dev, &occluded.buffer);
	device_release(dev, &visibility.buffer);
}

/* Run with a device that caches programs in a folder. @return number of programs taken from there */
static unsigned run_kept(const char *folder, int always)
{
	struct device *dev = NULL;
	unsigned found;

	ck_assert_int_eq(device_open("0", 0, &dev), 0);
	device_keep_programs(dev, folder, always);
	run_kernel(dev);
	found = device_programs_found(dev);
	device_close(&dev);
	return found;
}

/* The only file in a folder, its size, or -1 if there is none. No partial file may be left. */
static long the_file(const char *folder, char *path, size_t size)
{
	DIR *dir = opendir(folder);
	struct dirent *entry;
	struct stat info;
	long found = -1;

	while (dir && (entry = readdir(dir))) {
		if (entry->d_name[0] == '.')
			continue;
		ck_assert_int_eq(found, -1);
		ck_assert_ptr_nonnull(strstr(entry->d_name, ".program"));
		ck_assert_ptr_null(strstr(entry->d_name, ".part"));
		ck_assert_int_lt(snprintf(path, size, "%s/%s", folder, entry->d_name), (int)size);
		ck_assert_int_eq(stat(path, &info), 0);
		found = (long)info.st_size;
	}
	if (dir)
		closedir(dir);
	return found;
}

static void change_byte(const char *path, long at)
{
	FILE *file = fopen(path, "r+b");
	int byte;

	ck_assert_ptr_nonnull(file);
	fseek(file, at, SEEK_SET);
	byte = fgetc(file);
	fseek(file, at, SEEK_SET);
	fputc(byte ^ 0x10, file);
	fclose(file);
}

static void make_folder(char *folder, size_t size)
{
	ck_assert_int_lt(snprintf(folder, size - 8, "%s/programs-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp"),
	                 (int)size - 8);
	ck_assert_ptr_nonnull(mkdtemp(folder));
	strcat(folder, "/kept");
}

static void remove_folder(char *folder, const char *path)
{
	unlink(path);
	rmdir(folder);
	*strrchr(folder, '/') = '\0';
	rmdir(folder);
}

START_TEST(test_programs_are_kept)
{
	char folder[128], path[512];
	long size;

	make_folder(folder, sizeof(folder));
	ck_assert_uint_eq(run_kept(folder, 0), 0); /* PoCL has a cache of its own */
	ck_assert_int_eq(the_file(folder, path, sizeof(path)), -1);
	ck_assert_uint_eq(run_kept(folder, 1), 0);
	/*
	 * PoCL's binary grows once its own cache contains the kernels that ran; this is the size after a second
	 * compilation.
	 */
	ck_assert_int_gt(the_file(folder, path, sizeof(path)), 1000);
	ck_assert_int_eq(unlink(path), 0);
	ck_assert_uint_eq(run_kept(folder, 1), 0);
	size = the_file(folder, path, sizeof(path));
	ck_assert_uint_eq(run_kept(folder, 1), 1);
	/* Damaged contents, a damaged key, a truncated file: each is noticed and repaired. */
	for (int damage = 0; damage < 3; damage++) {
		if (damage == 2)
			ck_assert_int_eq(truncate(path, size / 2), 0);
		else
			change_byte(path, damage ? 9 : size / 2);
		ck_assert_uint_eq(run_kept(folder, 1), 0);
		ck_assert_int_eq(the_file(folder, path, sizeof(path)), size);
		ck_assert_uint_eq(run_kept(folder, 1), 1);
	}
	/* No writable folder: the kernels run anyway. */
	ck_assert_uint_eq(run_kept("/proc/self/fdinfo", 1), 0);
	ck_assert_uint_eq(run_kept("/dev/null/folder", 1), 0);
	remove_folder(folder, path);
}
END_TEST

/* Several processes at once. They fork before OpenCL is used, because its threads do not survive a fork. */
START_TEST(test_programs_are_shared)
{
	char folder[128], path[512];

	make_folder(folder, sizeof(folder));
	for (int i = 0; i < 4; i++)
		if (fork() == 0) {
			run_kept(folder, 1);
			_exit(0);
		}
	for (int i = 0; i < 4; i++) {
		int status;

		ck_assert_int_gt(wait(&status), 0);
		ck_assert_int_eq(status, 0);
	}
	ck_assert_int_gt(the_file(folder, path, sizeof(path)), 1000);
	ck_assert_uint_eq(run_kept(folder, 1), 1);
	remove_folder(folder, path);
}
END_TEST

/* A request for a kernel during the build waits; a build that nobody waits for is harmless. */
START_TEST(test_program_is_built_early)
{
	for (int run = 0; run < 4; run++) {
		struct device *dev = NULL, *other = NULL;

		ck_assert_int_eq(device_open("0", 0, &dev), 0);
		ck_assert_int_eq(device_share(dev, &other), 0);
		device_build_early(dev);
		device_build_early(other);
		if (run & 1) {
			run_kernel(other);
			run_kernel(dev);
		}
		if (run & 2)
			device_leave_programs(dev);
		device_close(&dev);
		device_close(&other);
	}
}
END_TEST

/* Number of this process' threads that may not run on all of its cores. */
static int count_pinned(const cpu_set_t *all)
{
	DIR *folder = opendir("/proc/self/task");
	struct dirent *entry;
	cpu_set_t cores;
	int n = 0;

	ck_assert_ptr_nonnull(folder);
	while ((entry = readdir(folder)))
		n += entry->d_name[0] != '.' && sched_getaffinity(atoi(entry->d_name), sizeof(cores), &cores) == 0 &&
		     !CPU_EQUAL(&cores, all);
	closedir(folder);
	return n;
}

/* PoCL's threads are pinned to a core each only if the process may use all cores (not 1), asks for it (not 2), and
 * there are enough cores (not 3). */
START_TEST(test_threads_stay_on_cores)
{
	const int n = (int)sysconf(_SC_NPROCESSORS_ONLN);
	struct device *dev = NULL;
	char threads[16];
	cpu_set_t cores;
	int last = CPU_SETSIZE - 1;

	ck_assert_int_eq(sched_getaffinity(0, sizeof(cores), &cores), 0);
	while (!CPU_ISSET(last, &cores))
		last--;
	if (_i == 1 && n > 1)
		CPU_CLR(last, &cores);
	ck_assert_int_eq(sched_setaffinity(0, sizeof(cores), &cores), 0);
	snprintf(threads, sizeof(threads), "%d", n + 3);
	if (_i == 3)
		setenv("POCL_MAX_PTHREAD_COUNT", threads, 1);
	ck_assert_int_eq(device_open("0", _i == 2, &dev), 0);
	ck_assert_int_eq(count_pinned(&cores), _i == 0 && n > 1 && CPU_COUNT(&cores) == n ? n : 0);
	run_kernel(dev);
	device_close(&dev);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("device");

	if (lacks_driver())
		return SKIPPED;
	tcase_add_test(tests, test_shared_device_takes_the_same_kernels);
	tcase_add_test(tests, test_profile);
	tcase_add_test(tests, test_programs_are_kept);
	tcase_add_test(tests, test_programs_are_shared);
	tcase_add_test(tests, test_program_is_built_early);
	tcase_add_loop_test(tests, test_threads_stay_on_cores, 0, 4);
	return run_case(tests, "device");
}
