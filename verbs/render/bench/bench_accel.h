/* relume bench --accel: trees of every kind side by side. */
#pragma once

#include <stddef.h>

#include "verbs/render/bench/bench.h"

/**
 * Build trees of several kinds over the bench's mesh and send its rays through each, in turn, n times. Print the
 * medians: time to build (by the clock, and of all processors together), SAH cost, items in leaves per triangle, memory
 * of what the device's kernels walk, and millions of camera, shadow and incoherent rays a second.
 *
 * @param kinds  bit 1 << enum accel_kind
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_accel(struct bench *bench, unsigned kinds, size_t n, int json);
