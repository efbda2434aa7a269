#include "tracer/frame/light/scan.h"

#include <stdlib.h>

#include "base/err.h"
#include "kernels/frame/stages/scan.h"

/* Replace the sums of chunks by the total before each. */
static uint32_t add_up(uint32_t *sums, uint32_t n, int *is_full)
{
	uint32_t before = 0, full = 0;

	for (uint32_t i = 0; i < n; i++) {
		const uint32_t sum = sums[i];

		sums[i] = before;
		before += sum & ~SCAN_FULL;
		full |= sum & SCAN_FULL;
	}
	*is_full = full != 0;
	return before;
}

/* sums: room for the sums of all chunks */
static int scan(struct device *dev, const struct scan_list *list, uint32_t *sums, uint32_t *total, int *is_full)
{
	const uint32_t n_sums = SCAN_ITEMS(list->n);
	int err = launch_reserve(dev, *list->scratch, n_sums);

	if (!err)
		err = launch_scan_sum(dev, n_sums,
		                      LAUNCH(scan_sum, .counts = list->counts, .n = list->n, .full = list->full,
		                             .sums = *list->scratch));
	if (!err)
		err = device_read(dev, list->scratch->buffer, 0, sums, n_sums * sizeof(*sums));
	if (!err)
		*total = add_up(sums, n_sums, is_full);
	if (err || *total == 0)
		return err;
	err = launch_reserve(dev, *list->places, list->n);
	if (!err)
		err = device_write(dev, list->scratch->buffer, 0, sums, n_sums * sizeof(*sums));
	return err ? err :
	             launch_scan_place(dev, n_sums,
	                               LAUNCH(scan_place, .counts = list->counts, .n = list->n,
	                                      .before = *list->scratch, .places = *list->places));
}

int scan_counts(struct device *dev, const struct scan_list *list, uint32_t *total, int *is_full)
{
	int full = 0, err;
	uint32_t *sums;

	*total = 0;
	if (list->n == 0)
		return 0;
	sums = malloc(SCAN_ITEMS(list->n) * sizeof(*sums));
	if (!sums)
		return err_report(ERR_SYSTEM, NULL, "out of memory for the sums of %u counts", list->n);
	err = scan(dev, list, sums, total, &full);
	free(sums);
	if (is_full)
		*is_full = full;
	return err;
}
