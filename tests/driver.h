/** tests/driver.h: what tests do where OpenCL has no driver. */
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tracer/device/device.h"

/* The exit code of a test that is skipped (tests/run.py). */
enum { SKIPPED = 77 };

/**
 * Whether no driver is installed: says so in a line, as tests/run.py wants a reason. A process of its own asks: libcheck's tests are
 * children of this one, and a driver's threads are not.
 */
static inline bool lacks_driver(void)
{
	const pid_t child = fork();
	int status = 0;

	if (child == 0) {
		struct device_description *list = NULL;
		size_t n = 0;

		_exit(device_list(&list, &n) != 0 || n == 0);
	}
	if (child < 0 || waitpid(child, &status, 0) != child || status == 0)
		return false;
	puts("no OpenCL driver here");
	return true;
}
