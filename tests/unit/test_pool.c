/* Pools: a frame's data is placed at the reported offsets and written once, small items together. */
#include <string.h>

#include "tests/case.h"
#include "tracer/frame/common/pool.h"

#define N_SMALL 500
#define MANY_WORDS 600000 /* more than a pool writes at once */

struct thing {
	uint32_t number, words;
};

static uint32_t read_back[MANY_WORDS];

static void fill(const void *object, uint32_t *words)
{
	const struct thing *thing = object;

	for (uint32_t i = 0; i < thing->words; i++)
		words[i] = thing->number * 1000003 + i;
}

static void check_items(struct pool *pool, struct device *dev, const struct pool_item *items, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		const struct thing *thing = items[i].object;

		if (!thing->words)
			continue;
		ck_assert_int_eq(device_read(dev, pool->buffer, items[i].place * sizeof(*read_back), read_back,
		                             thing->words * sizeof(*read_back)), 0);
		for (uint32_t k = 0; k < thing->words; k++)
			ck_assert_uint_eq(read_back[k], thing->number * 1000003 + k);
	}
}

START_TEST(test_items_are_written_together)
{
	struct thing things[N_SMALL + 1];
	struct pool_item items[N_SMALL + 1];
	struct device_profile profile = { .writes = { .count = 0 } };
	struct pool pool = { .capacity = 0 };
	struct device *dev = NULL;

	ck_assert_int_eq(device_open("reference", 1, &dev), 0);
	device_set_profile(dev, &profile);
	for (uint32_t i = 0; i <= N_SMALL; i++) {
		things[i] = (struct thing){ i, i == N_SMALL ? MANY_WORDS : i % 7 };
		items[i] = (struct pool_item){ { i + 1, 7 * i + 1 }, things[i].words, &things[i], 0 };
	}
	ck_assert_int_eq(pool_place(&pool, dev, items, N_SMALL / 2, fill), 0);
	ck_assert_uint_eq(profile.writes.count, 1);
	check_items(&pool, dev, items, N_SMALL / 2);
	/* Half is already placed; the large item is placed alone. */
	ck_assert_int_eq(pool_place(&pool, dev, items, N_SMALL + 1, fill), 0);
	ck_assert_uint_eq(profile.writes.count, 3);
	check_items(&pool, dev, items, N_SMALL + 1);
	ck_assert_int_eq(pool_place(&pool, dev, items, N_SMALL + 1, fill), 0);
	ck_assert_uint_eq(pool.used, profile.writes.amount / sizeof(uint32_t));
	pool_free(&pool, dev);
	device_close(&dev);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("pool");

	tcase_add_test(tests, test_items_are_written_together);
	return run_case(tests, "pool");
}
