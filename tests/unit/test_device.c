/* Devices: what a shared one has in common with its parent, and what a profile counts. */
#include <check.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/shared.h"
#include "tracer/device.h"

/* A second queue that took the kernels for GPUs on a CPU would be several times slower, and nobody would see why. */
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
	struct device_buffer *stopped = NULL, *arriving = NULL;
	struct device_profile profile;
	uint32_t flags[4] = { 0, 1, 0, 1 }, first = 1, n = 4;
	float weight = 0.5f, out[12];
	struct device_arg args[5];

	memset(&profile, 0, sizeof(profile));
	ck_assert_int_eq(device_open("reference", 2, &dev), 0);
	ck_assert_int_eq(device_reserve(dev, &stopped, sizeof(flags)), 0);
	ck_assert_int_eq(device_reserve(dev, &arriving, sizeof(out)), 0);
	args[0] = ARG_BUFFER(stopped);
	args[1] = ARG_VALUE(weight);
	args[2] = ARG_VALUE(first);
	args[3] = ARG_VALUE(n);
	args[4] = ARG_BUFFER(arriving);
	device_set_profile(dev, &profile);
	ck_assert_int_eq(device_write(dev, stopped, 0, flags, sizeof(flags)), 0);
	ck_assert_int_eq(device_run(dev, KERNEL_shadow_sum, n, args, 5), 0);
	device_set_profile(dev, NULL);
	ck_assert_int_eq(device_read(dev, arriving, 0, out, sizeof(out)), 0);
	ck_assert_float_eq(out[0], 0.5f);
	ck_assert_float_eq(out[3], 0);
	ck_assert_uint_eq(profile.writes.count, 1);
	ck_assert_uint_eq(profile.writes.amount, sizeof(flags));
	ck_assert_uint_eq(profile.kernels[KERNEL_shadow_sum].count, 1);
	ck_assert_uint_eq(profile.kernels[KERNEL_shadow_sum].amount, n);
	ck_assert(profile.kernels[KERNEL_shadow_sum].wall_s > 0);
	ck_assert_uint_eq(profile.reads.count, 0);
	ck_assert_str_eq(device_kernel_name(KERNEL_shadow_sum), "shadow_sum");
	device_release(dev, &stopped);
	device_release(dev, &arriving);
	device_close(&dev);
}
END_TEST

int main(void)
{
	Suite *suite = suite_create("device");
	TCase *tests = tcase_create("device");
	SRunner *runner;
	int failed;

	tcase_add_test(tests, test_shared_device_takes_the_same_kernels);
	tcase_add_test(tests, test_profile);
	suite_add_tcase(suite, tests);
	runner = srunner_create(suite);
	srunner_run_all(runner, CK_NORMAL);
	failed = srunner_ntests_failed(runner);
	srunner_free(runner);
	return failed != 0;
}
