#include "tracer/frame/scan.h"

#include "kernels/frame/scan.h"

/* log64 of 2^32, rounded up, and the counts themselves. */
#define MAX_LEVELS 7

/* Counts, sums of 64 of these, sums of 64 of those ... one sum. All but the first lie one after the other in the scratch buffer. */
struct level {
	const struct device_buffer *buffer;
	uint32_t first, n;
};

static int run_sum(struct device *dev, const struct level *from, const struct level *to)
{
	const struct device_arg args[] = { ARG_BUFFER(from->buffer), ARG_VALUE(from->first), ARG_VALUE(from->n),
		                           ARG_BUFFER(to->buffer), ARG_VALUE(to->first) };

	return device_run(dev, KERNEL_scan_sum, to->n, args, sizeof(args) / sizeof(args[0]));
}

static int run_place(struct device *dev, const struct level *counts, const struct level *before, const struct level *places)
{
	const struct device_arg args[] = { ARG_BUFFER(counts->buffer), ARG_VALUE(counts->first), ARG_VALUE(counts->n),
		                           ARG_BUFFER(before->buffer), ARG_VALUE(before->first), ARG_BUFFER(places->buffer),
		                           ARG_VALUE(places->first) };

	return device_run(dev, KERNEL_scan_place, before->n, args, sizeof(args) / sizeof(args[0]));
}

int scan_counts(struct device *dev, const struct device_buffer *counts, uint32_t n, struct device_buffer **places,
                struct device_buffer **scratch, uint32_t *total)
{
	struct level levels[MAX_LEVELS] = { { counts, 0, n } }, out = { .n = n };
	uint32_t words = 0, n_levels = 1, zero = 0;
	int err;

	*total = 0;
	if (n == 0)
		return 0;
	do {
		levels[n_levels] = (struct level){ NULL, words, SCAN_ITEMS(levels[n_levels - 1].n) };
		words += levels[n_levels].n;
	} while (levels[n_levels++].n > 1);
	err = device_reserve(dev, scratch, words * sizeof(uint32_t));
	for (uint32_t i = 1; i < n_levels; i++)
		levels[i].buffer = *scratch;
	for (uint32_t i = 1; i < n_levels && !err; i++)
		err = run_sum(dev, &levels[i - 1], &levels[i]);
	if (!err)
		err = device_read(dev, *scratch, (words - 1) * sizeof(uint32_t), total, sizeof(*total));
	if (err || *total == 0)
		return err;
	err = device_reserve(dev, places, n * sizeof(uint32_t));
	if (!err)
		err = device_write(dev, *scratch, (words - 1) * sizeof(uint32_t), &zero, sizeof(zero));
	for (uint32_t i = n_levels - 2; i > 0 && !err; i--)
		err = run_place(dev, &levels[i], &levels[i + 1], &levels[i]);
	out.buffer = *places;
	return err ? err : run_place(dev, &levels[0], &levels[1], &out);
}
