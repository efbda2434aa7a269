/* C twins of kernels/frame/stages/scan.cl. */
#include "kernels/frame/stages/scan.h"
#include "kernels/kernels.h"

void scan_sum_c(const struct scan_sum_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < SCAN_ITEMS(a->n); i++) {
		uint32_t sum = 0, full = 0;

		for (size_t k = i * SCAN_CHUNK; k < a->n && k < (i + 1) * SCAN_CHUNK; k++) {
			sum += a->counts[k];
			full |= a->counts[k] == a->full ? SCAN_FULL : 0;
		}
		a->sums[i] = sum | full;
	}
}

void scan_place_c(const struct scan_place_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < SCAN_ITEMS(a->n); i++) {
		uint32_t at = a->before[i];

		for (size_t k = i * SCAN_CHUNK; k < a->n && k < (i + 1) * SCAN_CHUNK; k++) {
			a->places[k] = at;
			at += a->counts[k];
		}
	}
}
