/** tests/check/on_devices.h: running kernels on each device. */
#pragma once

#include <check.h>
#include <stdio.h>
#include <stdlib.h>

#include "tracer/device/device.h"

/** A buffer with these bytes. */
static inline struct device_buffer *make_buffer(struct device *dev, const void *data, size_t bytes)
{
	struct device_buffer *b = NULL;

	ck_assert_int_eq(device_reserve(dev, &b, bytes), 0);
	ck_assert_int_eq(device_write(dev, b, 0, data, bytes), 0);
	return b;
}

/** Check the twins, then each OpenCL device. check: receives an open device */
static inline void on_each_device(void (*check)(struct device *dev, void *user), void *user)
{
	struct device_description *devices = NULL;
	struct device *dev = NULL;
	char number[24] = "reference";
	size_t n = 0;

	device_list(&devices, &n);
	for (size_t d = 0; d <= n; d++) {
		ck_assert_int_eq(device_open(number, 1, &dev), 0);
		check(dev, user);
		device_close(&dev);
		snprintf(number, sizeof(number), "%zu", d);
	}
	free(devices);
}
