/*
 * Runs work in a process that an OpenCL driver may end: a parent, which uses no driver, waits for a worker process, and
 * starts another one if the driver was at fault (tracer/device/fault.h). State that the next worker needs is in shared
 * memory.
 *
 * Otherwise the two look like one process. Signals that the parent is sent reach the worker, the worker ends with its
 * parent, and the parent ends as the worker did: by exit code or by signal.
 */
#pragma once

#include <stdatomic.h>
#include <sys/types.h>

#include "tracer/device/fault.h"

/* In memory of apart_alloc; all 0 at first. */
struct guard {
	unsigned attempt;   /* counted from 1; 0: there is no parent, and a fault ends the run */
	pid_t gone;         /* the previous worker; 0: none */
	struct fault last;  /* the fault that ended it */
	struct fault_journal journal; /* journal of this attempt */
	atomic_int is_over; /* the work has returned `code`; later faults do not count */
	int code;
};

/**
 * Run a function in a worker, and again after each fault. Call it before the first thread is started.
 * @param guard  within memory of apart_alloc
 * @return the function's exit code, in the worker, or if no process can be started; the parent does not return
 */
int guard_run(struct guard *guard, int (*function)(void *user), void *user);

/** In the worker: 1 if the parent passed on the signal that came. The members of a process group get each signal
 * twice that way. */
int guard_is_passed_on(const struct guard *guard, int si_code);
