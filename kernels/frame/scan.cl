/* scan_sum, scan_place: see kernels/frame/scan.h. */
#include "kernels/frame/scan.h"
#include "kernels/kernels.h"

__kernel void scan_sum(KERNEL_ARGUMENTS(scan_sum))
{
	const uint i = (uint)get_global_id(0);
	uint sum = 0;

	if (i >= SCAN_ITEMS(n))
		return;
	for (uint k = i * SCAN_CHUNK; k < min(n, (i + 1) * SCAN_CHUNK); k++)
		sum += counts[count_first + k];
	sums[sum_first + i] = sum;
}

__kernel void scan_place(KERNEL_ARGUMENTS(scan_place))
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
