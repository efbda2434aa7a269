/* Prefix sums on a device: kernels/frame/scan.h. */
#pragma once

#include <stdint.h>

#include "tracer/device/launch.h"

/** How many results each of n items has. Buffers are kept by the caller, from one list to the next. */
struct scan_list {
	union buffer_uint counts;            /* uint[n]; together less than 2^31 */
	uint32_t n;
	uint32_t full;                       /* a count that is looked for; SCENE_NONE: none is */
	union buffer_uint *places, *scratch; /* made large enough; nothing else is kept in scratch */
};

/**
 * Places of items' results in a dense list, in the items' order.
 * @param list     its places receive uint[n], where there are any results; they are not its counts
 * @param total    receives how many results there are
 * @param is_full  receives whether any count is list->full; NULL: nobody asks
 * @return 0 or ERR_SYSTEM (reported)
 */
int scan_counts(struct device *dev, const struct scan_list *list, uint32_t *total, int *is_full);
