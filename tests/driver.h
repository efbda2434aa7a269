/** tests/driver.h: skipping tests if OpenCL has no driver. */
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* The exit code of a skipped test (tests/run.py). */
enum { SKIPPED = 77 };

/** Whether no driver is installed; if so, prints a line with the reason, for tests/run.py. A driver that does not
 * work is a failure. */
static inline bool lacks_driver(void)
{
	const char *installed = getenv("RELUME_VENDORS"); /* set by tests/run.py: empty if there is none */

	if (!installed || *installed)
		return false;
	puts("no OpenCL driver here");
	return true;
}
