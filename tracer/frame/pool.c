#include "tracer/frame/pool.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define POOL_LEAST_WORDS ((size_t)1 << 20)

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

/* Room for n more entries, at most half full. */
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

static int write_item(struct pool *pool, struct device *dev, const struct pool_item *item, pool_fill *fill)
{
	uint32_t *words = malloc(item->words * sizeof(*words));
	int err;

	if (!words)
		return err_report(ERR_SYSTEM, NULL, "out of memory: %zu bytes", item->words * sizeof(*words));
	fill(item->object, words);
	err = device_write(dev, pool->buffer, pool->used * sizeof(*words), words, item->words * sizeof(*words));
	free(words);
	return err;
}

int pool_place(struct pool *pool, struct device *dev, struct pool_item *items, size_t n, pool_fill *fill)
{
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
		/* Without room for more. */
		pool->capacity = total;
		err = device_reserve(dev, &pool->buffer, total * sizeof(uint32_t));
	}
	for (size_t i = 0; i < n && !err; i++) {
		struct pool_entry *entry = find(pool, items[i].hash);

		if (!entry->used && items[i].words)
			err = write_item(pool, dev, &items[i], fill);
		if (!entry->used && !err) {
			*entry = (struct pool_entry){ { items[i].hash[0], items[i].hash[1] }, (uint32_t)pool->used, 1 };
			pool->used += items[i].words;
			pool->n_entries++;
		}
		items[i].place = entry->place;
	}
	return err;
}

void pool_free(struct pool *pool, struct device *dev)
{
	device_release(dev, &pool->buffer);
	free(pool->entries);
	memset(pool, 0, sizeof(*pool));
}
