/** tests/driver.h: what tests do where OpenCL has no driver. */
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* The exit code of a test that is skipped (tests/run.py). */
enum { SKIPPED = 77 };

/** Whether no driver is installed: says so in a line, as tests/run.py wants a reason. One that does not work is a
 * failure. */
static inline bool lacks_driver(void)
{
	const char *installed = getenv("RELUME_VENDORS"); /* tests/run.py: empty where there is none */

	if (!installed || *installed)
		return false;
	puts("no OpenCL driver here");
	return true;
}
