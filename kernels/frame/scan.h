/*
 * Prefix sums (Blelloch 1990, "Prefix sums and their applications"): the place of each item's results in a dense list is the sum of
 * all counts before. Included by C and OpenCL C.
 *
 * A work item sums SCAN_CHUNK consecutive counts. The sums are counts again, until there is one: the total. On the way back down
 * the sum of all before replaces each sum. Integers are added in a fixed order of launches, and no work item waits for another:
 * nothing depends on scheduling.
 *
 * scan_sum: sums[sum_first + i] = counts[count_first + SCAN_CHUNK i] + .. as far as n counts go
 *
 * scan_place: places[place_first + k] = what stands before chunk i + the counts before count k of chunk i. counts and places may
 * be the same.
 *
 * Work items: SCAN_ITEMS(n).
 */
#pragma once

#define SCAN_CHUNK 64u
#define SCAN_ITEMS(n) (((n) + SCAN_CHUNK - 1u) / SCAN_CHUNK)
