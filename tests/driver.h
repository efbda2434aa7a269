/** tests/driver.h: what tests do where OpenCL has no driver. */
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "tracer/device/device.h"

/* The exit code of a test that is skipped (tests/run.py). */
enum { SKIPPED = 77 };

/** Whether no driver is installed: says so in a line, as tests/run.py wants a reason. */
static inline bool lacks_driver(void)
{
	struct device_description *list = NULL;
	size_t n = 0;
	const bool lacks = device_list(&list, &n) != 0 || n == 0;

	free(list);
	if (lacks)
		puts("no OpenCL driver here");
	return lacks;
}
