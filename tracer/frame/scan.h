/* Prefix sums on a device: kernels/frame/scan.h. */
#pragma once

#include <stdint.h>

#include "tracer/device/launch.h"

/**
 * Places of n items' results in a dense list, in the items' order.
 * @param counts   uint[n]: how many results each item has; together less than 2^32
 * @param places   made large enough; receives uint[n]. Not `counts`
 * @param scratch  a buffer that nothing else is kept in
 * @param total    receives how many results there are; places are written only where there are some
 * @return 0 or ERR_SYSTEM (reported)
 */
int scan_counts(struct device *dev, union buffer_uint counts, uint32_t n, union buffer_uint *places, union buffer_uint *scratch,
                uint32_t *total);
