/*
 * Threads of a driver that stay on a core each. Linux often wakes both threads of a launch on one of two cores, and
 * leaves them there for its length. PoCL's own way (POCL_AFFINITY) ends the process where it has more threads than
 * there are cores.
 */
#pragma once

#include <stddef.h>
#include <sys/types.h>

#define CL_PIN_MOST 512

/* The threads of the process before a driver was loaded. */
struct cl_pin {
	pid_t threads[CL_PIN_MOST];
	size_t n;
};

void cl_pin_begin(struct cl_pin *pin);

/** Where as many threads have begun since as the process may use cores, and it may use all: give them one each. */
void cl_pin_end(const struct cl_pin *pin);
