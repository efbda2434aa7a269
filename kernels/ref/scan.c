/* C twins of kernels/frame/scan.cl. */
#include "kernels/frame/scan.h"
#include "tracer/device/device.h"

extern device_twin scan_sum_c, scan_place_c;

static uint32_t number(const void *arg)
{
	return *(const uint32_t *)arg;
}

void scan_sum_c(const void *const *args, size_t first, size_t last)
{
	const uint32_t *counts = (const uint32_t *)args[0] + number(args[1]), n = number(args[2]);
	uint32_t *sums = (uint32_t *)args[3] + number(args[4]);

	for (size_t i = first; i < last && i < SCAN_ITEMS(n); i++) {
		sums[i] = 0;
		for (size_t k = i * SCAN_CHUNK; k < n && k < (i + 1) * SCAN_CHUNK; k++)
			sums[i] += counts[k];
	}
}

void scan_place_c(const void *const *args, size_t first, size_t last)
{
	const uint32_t *counts = (const uint32_t *)args[0] + number(args[1]), n = number(args[2]);
	const uint32_t *before = (const uint32_t *)args[3] + number(args[4]);
	uint32_t *places = (uint32_t *)args[5] + number(args[6]);

	for (size_t i = first; i < last && i < SCAN_ITEMS(n); i++) {
		uint32_t at = before[i];

		for (size_t k = i * SCAN_CHUNK; k < n && k < (i + 1) * SCAN_CHUNK; k++) {
			const uint32_t count = counts[k];

			places[k] = at;
			at += count;
		}
	}
}
