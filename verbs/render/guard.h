/*
 * Work in a process that may be ended by an OpenCL driver: a parent, which has touched no driver, waits for a worker
 * process, and starts another one where the driver was at fault (tracer/device/fault.h). What the next worker must know
 * lies in memory that all share.
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
	unsigned attempt;   /* from 1 on; 0: there is no parent, and a fault ends the run */
	pid_t gone;         /* the worker before; 0: none */
	struct fault last;  /* that ended it */
	struct fault_journal journal; /* of this attempt */
	atomic_int is_over; /* the work has returned `code`: nothing that follows counts */
	int code;
};

/**
 * Run a function in a worker, once more for each fault. Call it before the first thread is started.
 * @param guard  within memory of apart_alloc
 * @return the function's exit code: in the worker, and where no process can be started; the parent does not return
 */
int guard_run(struct guard *guard, int (*function)(void *user), void *user);

/** In the worker, of a signal that came: 1 where the parent has passed it on. A process group gets each signal twice
 * so. */
int guard_is_passed_on(const struct guard *guard, int si_code);
