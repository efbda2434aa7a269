/* scan_sum, scan_place: see kernels/frame/scan.h. */
#include "kernels/frame/scan.h"

__kernel void scan_sum(__global const uint *counts, uint count_first, uint n, __global uint *sums, uint sum_first)
{
	const uint i = (uint)get_global_id(0);
	uint sum = 0;

	if (i >= SCAN_ITEMS(n))
		return;
	for (uint k = i * SCAN_CHUNK; k < min(n, (i + 1) * SCAN_CHUNK); k++)
		sum += counts[count_first + k];
	sums[sum_first + i] = sum;
}

__kernel void scan_place(__global const uint *counts, uint count_first, uint n, __global const uint *before, uint before_first,
                         __global uint *places, uint place_first)
{
	const uint i = (uint)get_global_id(0);
	uint at;

	if (i >= SCAN_ITEMS(n))
		return;
	at = before[before_first + i];
	for (uint k = i * SCAN_CHUNK; k < min(n, (i + 1) * SCAN_CHUNK); k++) {
		const uint count = counts[count_first + k];

		places[place_first + k] = at;
		at += count;
	}
}
