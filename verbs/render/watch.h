/*
 * Ends a frame or the run on signals and at the limits of time and memory. One thread watches all of these and
 * interrupts devices (device_interrupt). A worker whose device was interrupted asks here why.
 *
 * The first SIGINT or SIGTERM stops the run: frames on devices are interrupted. A second one, or twenty seconds without
 * an end, removes unfinished files and ends the process at once, with 128 + the signal's number.
 *
 * A driver call that hangs also ends the process; its parent starts another one (guard.h).
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

#include "tracer/device/device.h"

#define WATCH_MAX_SEATS 256

struct watch;

struct guard;

struct watch_limits {
	double frame_s;        /* seconds that a frame may take, 0: any */
	double driver_s;       /* that a call of an OpenCL driver may take (fault_look), 0: any */
	uint64_t memory_bytes; /* that the process may take while a single frame is under way, 0: any */
};

/**
 * Start watching. Blocks both signals in the calling thread; threads started later inherit that: call it first.
 * @param guard  of this process, whose parent passes signals on
 * @return 0 or ERR_SYSTEM (reported)
 */
int watch_start(struct watch **out, const struct guard *guard, const struct watch_limits *limits);

/** Stop watching. Signals that came are not delivered again. */
void watch_stop(struct watch **w);

/** The signal that asked for an end, or 0. */
int watch_signal(const struct watch *w);

/** 1 once no new frame may begin: a signal came, or watch_give_up was called. */
int watch_is_over(const struct watch *w);

/** Something failed for good: interrupt everything. */
void watch_give_up(struct watch *w);

/** Add a device of the run. @return its seat, or -1: all are taken */
int watch_add(struct watch *w, struct device *dev);

/** A frame begins or ends on a seat. watch_end returns 1 if the frame ran out of time (and resumes the device). */
void watch_begin(struct watch *w, int seat, uint64_t frame);
int watch_end(struct watch *w, int seat);

/** Memory of this process now, in bytes. */
uint64_t watch_memory(void);
