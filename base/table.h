/*
 * Hash tables from 64-bit keys to pointers, open addressing. All zero is a valid empty table. Values are not owned; a
 * NULL value is an empty place.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct table_entry {
	uint64_t key;
	void *value;
};
struct table {
	struct table_entry *entries; /* [room], room a power of two */
	size_t n, room;
};

/** The value of a key, or NULL. */
void *table_find(const struct table *t, uint64_t key);

/** Set a key's value (not NULL). @return 0 or ERR_SYSTEM (reported) */
int table_set(struct table *t, uint64_t key, void *value);

/** @return the value removed, or NULL */
void *table_remove(struct table *t, uint64_t key);

void table_free(struct table *t);

/** Free a table and, with drop(value), every value in it. */
#define TABLE_DROP(t, drop) \
	do { \
		for (size_t i_ = 0; i_ < (t)->room; i_++) \
			if ((t)->entries[i_].value) \
				drop((t)->entries[i_].value); \
		table_free(t); \
	} while (0)
