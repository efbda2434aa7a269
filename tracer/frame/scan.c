#include "tracer/frame/scan.h"

#include "kernels/frame/scan.h"

/* log64 of 2^32, rounded up, and the counts themselves. */
#define MAX_LEVELS 7

/* Counts, then sums of 64 counts, sums of 64 sums, until there is one sum. All but the counts lie one after the other in `scratch`. */
struct level {
	union buffer_uint buffer;
	uint32_t first, n;
};

static int run_sum(struct device *dev, const struct level *from, const struct level *to)
{
	return launch_scan_sum(dev, to->n, LAUNCH(scan_sum, .counts = from->buffer, .count_first = from->first, .n = from->n,
	                                          .sums = to->buffer, .sum_first = to->first));
}

static int run_place(struct device *dev, const struct level *counts, const struct level *before, const struct level *places)
{
	return launch_scan_place(dev, before->n, LAUNCH(scan_place, .counts = counts->buffer, .count_first = counts->first,
	                                                .n = counts->n, .before = before->buffer, .before_first = before->first,
	                                                .places = places->buffer, .place_first = places->first));
}

int scan_counts(struct device *dev, union buffer_uint counts, uint32_t n, union buffer_uint *places, union buffer_uint *scratch,
                uint32_t *total)
{
	struct level levels[MAX_LEVELS] = { { counts, 0, n } }, out = { .n = n };
	uint32_t words = 0, n_levels = 1, zero = 0;
	int err;

	*total = 0;
	if (n == 0)
		return 0;
	do {
		levels[n_levels] = (struct level){ .first = words, .n = SCAN_ITEMS(levels[n_levels - 1].n) };
		words += levels[n_levels].n;
	} while (levels[n_levels++].n > 1);
	err = launch_reserve(dev, *scratch, words);
	for (uint32_t i = 1; i < n_levels; i++)
		levels[i].buffer = *scratch;
	for (uint32_t i = 1; i < n_levels && !err; i++)
		err = run_sum(dev, &levels[i - 1], &levels[i]);
	if (!err)
		err = device_read(dev, scratch->buffer, (words - 1) * sizeof(uint32_t), total, sizeof(*total));
	if (err || *total == 0)
		return err;
	err = launch_reserve(dev, *places, n);
	if (!err)
		err = device_write(dev, scratch->buffer, (words - 1) * sizeof(uint32_t), &zero, sizeof(zero));
	for (uint32_t i = n_levels - 2; i > 0 && !err; i--)
		err = run_place(dev, &levels[i], &levels[i + 1], &levels[i]);
	out.buffer = *places;
	return err ? err : run_place(dev, &levels[0], &levels[1], &out);
}
