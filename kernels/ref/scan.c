/* C twins of kernels/frame/scan.cl. */
#include "kernels/frame/scan.h"
#include "kernels/kernels.h"

void scan_sum_c(const struct scan_sum_arguments *a, size_t first, size_t last)
{
	const uint32_t *counts = a->counts + a->count_first, n = a->n;
	uint32_t *sums = a->sums + a->sum_first;

	for (size_t i = first; i < last && i < SCAN_ITEMS(n); i++) {
		sums[i] = 0;
		for (size_t k = i * SCAN_CHUNK; k < n && k < (i + 1) * SCAN_CHUNK; k++)
			sums[i] += counts[k];
	}
}

void scan_place_c(const struct scan_place_arguments *a, size_t first, size_t last)
{
	const uint32_t *counts = a->counts + a->count_first, *before = a->before + a->before_first, n = a->n;
	uint32_t *places = a->places + a->place_first;

	for (size_t i = first; i < last && i < SCAN_ITEMS(n); i++) {
		uint32_t at = before[i];

		for (size_t k = i * SCAN_CHUNK; k < n && k < (i + 1) * SCAN_CHUNK; k++) {
			const uint32_t count = counts[k];

			places[k] = at;
			at += count;
		}
	}
}
