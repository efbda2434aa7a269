/*
 * A device buffer that caches arrays by content (vertex arrays, indices, texels) as long as they fit. A frame uploads
 * only arrays that the previous frames did not have.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "tracer/device/launch.h"

struct pool_entry;

struct pool {
	union { /* 4-byte words */
		struct device_buffer *buffer;
		union buffer_uint words;
		union buffer_float floats;
	};
	size_t capacity, used;        /* words */
	struct pool_entry *entries;   /* hash table, open addressing */
	size_t n_entries, n_slots;
};

/* An array that the frame needs. */
struct pool_item {
	uint64_t hash[2];
	size_t words;
	const void *object; /* passed to pool_fill */
	uint32_t place;     /* receives the index of its first word */
};

/** Write an item's words. */
typedef void pool_fill(const void *object, uint32_t *words);

/**
 * Put all of a frame's items into the buffer. Items of earlier frames may be evicted.
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int pool_place(struct pool *pool, struct device *dev, struct pool_item *items, size_t n, pool_fill *fill);

void pool_free(struct pool *pool, struct device *dev);
