/* Prefix sums on a device: kernels/frame/stages/scan.h. */
#pragma once

#include <stdint.h>

#include "tracer/device/launch.h"

/** Numbers of results of n items. The caller keeps the buffers from one list to the next. */
struct scan_list {
	union buffer_uint counts;            /* uint[n]; together less than 2^31 */
	uint32_t n;
	uint32_t full;                       /* a count to search for; SCENE_NONE: none */
	union buffer_uint *places, *scratch; /* grown as needed; scratch holds nothing else */
};

/**
 * Compute the positions of items' results in a dense list, in the order of the items.
 * @param list     its places receive uint[n] if there are any results; they must not be the same buffer as its counts
 * @param total    receives the number of results
 * @param is_full  receives 1 if any count is list->full, else 0; may be NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int scan_counts(struct device *dev, const struct scan_list *list, uint32_t *total, int *is_full);
