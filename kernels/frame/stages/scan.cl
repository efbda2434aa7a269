/* scan_sum, scan_place: see kernels/frame/stages/scan.h. */
#include "kernels/frame/stages/scan.h"
#include "kernels/kernels.h"

__kernel void scan_sum(KERNEL_ARGUMENTS(scan_sum))
{
	const uint i = (uint)get_global_id(0);
	uint sum = 0, is_full = 0;

	if (i >= SCAN_ITEMS(n))
		return;
	for (uint k = i * SCAN_CHUNK; k < min(n, (i + 1) * SCAN_CHUNK); k++) {
		sum += counts[k];
		is_full |= counts[k] == full;
	}
	sums[i] = sum | (is_full ? SCAN_FULL : 0);
}

__kernel void scan_place(KERNEL_ARGUMENTS(scan_place))
{
	const uint i = (uint)get_global_id(0);
	uint at;

	if (i >= SCAN_ITEMS(n))
		return;
	at = before[i];
	for (uint k = i * SCAN_CHUNK; k < min(n, (i + 1) * SCAN_CHUNK); k++) {
		places[k] = at;
		at += counts[k];
	}
}
