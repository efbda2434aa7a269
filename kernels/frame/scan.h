/*
 * Where each of many items' results go when they stand densely: sums of all counts before (Blelloch 1990, "Prefix sums and their
 * applications"). Included by C and OpenCL C.
 *
 * A work item sums SCAN_CHUNK consecutive counts; its sums are counts again, until there is one: the total. On the way back down
 * each sum is replaced by what stands before it. Additions of integers in a fixed order of launches, none of which
 * waits for another work item: nothing depends on scheduling.
 *
 * scan_sum: sums[sum_first + i] = counts[count_first + SCAN_CHUNK i] + .. as far as n counts go
 *
 * scan_place: places[place_first + k] = what stands before chunk i + the counts before count k of chunk i. counts and places may
 * be the same.
 *
 * Work items: SCAN_ITEMS(n).
 */
#ifndef KERNELS_FRAME_SCAN_H
#define KERNELS_FRAME_SCAN_H

#define SCAN_CHUNK 64u
#define SCAN_ITEMS(n) (((n) + SCAN_CHUNK - 1u) / SCAN_CHUNK)

#endif
