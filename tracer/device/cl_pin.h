/*
 * Pinning of a driver's threads, one to each core. Linux often wakes both threads of a launch on the same one of two
 * cores, and leaves them there until the launch ends. PoCL's own pinning (POCL_AFFINITY) ends the process if PoCL has
 * more threads than there are cores.
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

/** Pin each thread started since cl_pin_begin to its own core, if there are exactly as many as cores and the process
 * may use all cores. */
void cl_pin_end(const struct cl_pin *pin);
