/*
 * Prefix sums (Blelloch 1990, "Prefix sums and their applications"): the place of each item's results in a dense list
 * is the sum of all preceding counts. Included by C and OpenCL C.
 *
 * A work item sums SCAN_CHUNK consecutive counts; the host turns these sums into the total before each chunk. No work
 * item waits for another, so nothing depends on scheduling.
 *
 * scan_sum: sums[i] = counts[SCAN_CHUNK i] + .. up to count n; plus SCAN_FULL if one of them is `full`
 *
 * scan_place: places[k] = total before chunk i + the counts before count k in chunk i
 *
 * Work items: SCAN_ITEMS(n).
 */
#pragma once

#define SCAN_CHUNK 64u
#define SCAN_FULL 0x80000000u
#define SCAN_ITEMS(n) (((n) + SCAN_CHUNK - 1u) / SCAN_CHUNK)
