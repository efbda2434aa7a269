/* relume bench --accel: compares acceleration structures. */
#pragma once

#include <stddef.h>

#include "verbs/render/bench/bench.h"

/**
 * Build trees of several kinds over the bench's mesh and send its rays through each, in turn, n times. Print the
 * medians: build time (elapsed, and summed over all processors), SAH cost, items in leaves per triangle, memory of the
 * tree that the device's kernels traverse, and millions of camera, shadow and incoherent rays a second.
 *
 * @param kinds  bit 1 << enum accel_kind
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_accel(struct bench *bench, unsigned kinds, size_t n, int json);
