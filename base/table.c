#include "base/table.h"

#include <stdlib.h>

#include "base/err.h"

static size_t place_of(const struct table *t, uint64_t key)
{
	/* Fibonacci hashing: names are small numbers, hashes are not. */
	return (size_t)((key * 0x9e3779b97f4a7c15u) >> 20) & (t->room - 1);
}

void *table_find(const struct table *t, uint64_t key)
{
	if (!t->n)
		return NULL;
	for (size_t i = place_of(t, key);; i = (i + 1) & (t->room - 1)) {
		if (!t->entries[i].value)
			return NULL;
		if (t->entries[i].key == key)
			return t->entries[i].value;
	}
}

static int grow(struct table *t)
{
	struct table old = *t;

	t->room = old.room ? 2 * old.room : 16;
	t->entries = calloc(t->room, sizeof(*t->entries));
	if (!t->entries) {
		*t = old;
		return err_report(ERR_SYSTEM, NULL, "out of memory for a table of %zu entries", 2 * old.room);
	}
	for (size_t i = 0; i < old.room; i++) {
		size_t at;
		if (!old.entries[i].value)
			continue;
		for (at = place_of(t, old.entries[i].key); t->entries[at].value; at = (at + 1) & (t->room - 1))
			;
		t->entries[at] = old.entries[i];
	}
	free(old.entries);
	return 0;
}

int table_set(struct table *t, uint64_t key, void *value)
{
	size_t i;

	if (2 * (t->n + 1) > t->room && grow(t))
		return ERR_SYSTEM;
	for (i = place_of(t, key); t->entries[i].value && t->entries[i].key != key; i = (i + 1) & (t->room - 1))
		;
	t->n += !t->entries[i].value;
	t->entries[i] = (struct table_entry){ key, value };
	return 0;
}

void *table_remove(struct table *t, uint64_t key)
{
	size_t i, hole;
	void *value;

	if (!t->n)
		return NULL;
	for (i = place_of(t, key); t->entries[i].key != key || !t->entries[i].value; i = (i + 1) & (t->room - 1))
		if (!t->entries[i].value)
			return NULL;
	value = t->entries[i].value;
	t->entries[i].value = NULL;
	t->n--;
	/* Close the gap: move back entries that were displaced past it. */
	hole = i;
	for (i = (i + 1) & (t->room - 1); t->entries[i].value; i = (i + 1) & (t->room - 1)) {
		size_t home = place_of(t, t->entries[i].key);
		if (((i - home) & (t->room - 1)) >= ((i - hole) & (t->room - 1))) {
			t->entries[hole] = t->entries[i];
			t->entries[i].value = NULL;
			hole = i;
		}
	}
	return value;
}

void table_free(struct table *t)
{
	free(t->entries);
	*t = (struct table){ 0 };
}
