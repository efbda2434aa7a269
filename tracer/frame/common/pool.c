#include "tracer/frame/common/pool.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define POOL_LEAST_WORDS ((size_t)1 << 20)
/* words written to the device at a time; larger items are written one by one */
#define STAGE_WORDS ((size_t)1 << 18)

struct pool_entry {
	uint64_t hash[2];
	uint32_t place;
	int used;
};

static struct pool_entry *find(const struct pool *pool, const uint64_t hash[2])
{
	size_t slot = (size_t)hash[0] & (pool->n_slots - 1);

	while (pool->entries[slot].used &&
	       (pool->entries[slot].hash[0] != hash[0] || pool->entries[slot].hash[1] != hash[1]))
		slot = (slot + 1) & (pool->n_slots - 1);
	return &pool->entries[slot];
}

/* Make room for n more entries, with the table at most half full. */
static int reserve_entries(struct pool *pool, size_t n)
{
	struct pool old = *pool;
	size_t slots = pool->n_slots ? pool->n_slots : 64;

	while (slots < 2 * (pool->n_entries + n))
		slots *= 2;
	if (slots == pool->n_slots)
		return 0;
	pool->entries = calloc(slots, sizeof(*pool->entries));
	if (!pool->entries) {
		pool->entries = old.entries;
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	pool->n_slots = slots;
	for (size_t i = 0; i < old.n_slots; i++)
		if (old.entries[i].used)
			*find(pool, old.entries[i].hash) = old.entries[i];
	free(old.entries);
	return 0;
}

static void forget_all(struct pool *pool)
{
	memset(pool->entries, 0, pool->n_slots * sizeof(*pool->entries));
	pool->n_entries = pool->used = 0;
}

/* Items collected for the device, one after the other: each write costs waking and waiting for a thread of the
 * device. */
struct stage {
	uint32_t *words;
	size_t room, n; /* words */
};

/* Write the staged words: the last ones that the pool uses. */
static int write_stage(const struct pool *pool, struct device *dev, struct stage *stage)
{
	const size_t n = stage->n;

	stage->n = 0;
	return n == 0 ? 0 :
	                device_write(dev, pool->buffer, (pool->used - n) * sizeof(*stage->words), stage->words,
	                             n * sizeof(*stage->words));
}

/* Add an item after all others. */
static int add_item(struct pool *pool, struct device *dev, struct stage *stage, const struct pool_item *item,
                    pool_fill *fill)
{
	int err = stage->n + item->words > stage->room ? write_stage(pool, dev, stage) : 0;

	if (err)
		return err;
	if (item->words > stage->room) {
		free(stage->words);
		stage->room = item->words > STAGE_WORDS ? item->words : STAGE_WORDS;
		stage->words = malloc(stage->room * sizeof(*stage->words));
		if (!stage->words)
			return err_report(ERR_SYSTEM, NULL, "out of memory: %zu bytes",
			                  stage->room * sizeof(*stage->words));
	}
	fill(item->object, stage->words + stage->n);
	stage->n += item->words;
	pool->used += item->words;
	return 0;
}

int pool_place(struct pool *pool, struct device *dev, struct pool_item *items, size_t n, pool_fill *fill)
{
	struct stage stage = { .words = NULL };
	size_t missing = 0, total = 0;
	int err = reserve_entries(pool, n);

	if (err)
		return err;
	for (size_t i = 0; i < n; i++) {
		total += items[i].words;
		missing += find(pool, items[i].hash)->used ? 0 : items[i].words;
	}
	if (total > UINT32_MAX / 2)
		return err_report(ERR_SYSTEM, NULL, "a frame's data is too large: %zu MiB", total >> 18);
	if (pool->used + missing > pool->capacity) {
		forget_all(pool);
		while (pool->capacity < total)
			pool->capacity = pool->capacity ? pool->capacity * 2 : POOL_LEAST_WORDS;
	}
	err = device_reserve(dev, &pool->buffer, (pool->capacity ? pool->capacity : 1) * sizeof(uint32_t));
	if (err == ERR_MEMORY && pool->capacity > total) {
		/* Without spare room. */
		pool->capacity = total;
		err = device_reserve(dev, &pool->buffer, total * sizeof(uint32_t));
	}
	for (size_t i = 0; i < n && !err; i++) {
		struct pool_entry *entry = find(pool, items[i].hash);

		if (!entry->used) {
			*entry = (struct pool_entry){ { items[i].hash[0], items[i].hash[1] }, (uint32_t)pool->used, 1 };
			pool->n_entries++;
			err = items[i].words ? add_item(pool, dev, &stage, &items[i], fill) : 0;
		}
		items[i].place = entry->place;
	}
	if (!err)
		err = write_stage(pool, dev, &stage);
	free(stage.words);
	if (err)
		forget_all(pool); /* items that have places may not have been written */
	return err;
}

void pool_free(struct pool *pool, struct device *dev)
{
	device_release(dev, &pool->buffer);
	free(pool->entries);
	memset(pool, 0, sizeof(*pool));
}
