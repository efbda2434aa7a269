/* relume bench --accel: trees of every kind side by side. */
#ifndef TRACER_BENCH_BENCH_ACCEL_H
#define TRACER_BENCH_BENCH_ACCEL_H

#include <stddef.h>

#include "tracer/bench/bench.h"

/**
 * Build the bench's mesh into trees of several kinds and send its rays through each, in turn, n times; print the medians: the time to
 * build (by the clock, and of all processors together), the SAH cost, how many items leaves hold for each triangle, the memory of what the device's kernels walk, and
 * millions of camera, shadow and incoherent rays a second.
 *
 * @param kinds  bit 1 << enum accel_kind
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_accel(struct bench *bench, unsigned kinds, size_t n, int json);

#endif
