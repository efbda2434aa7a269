#include "replay/index/snapshot_parts.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/hash.h"

#define MAX_OBJECTS (1u << 24)

/* ---- saving ---- */

void saver_section(struct saver *s, const char *what, uint64_t number)
{
	if (s->out->n <= s->wanted && s->wanted != SIZE_MAX)
		snprintf(s->place, sizeof(s->place), "%s %llu, byte %zu", what, (unsigned long long)number,
		         s->wanted - s->out->n);
}

void saver_named_blob(struct saver *s, const uint64_t name[2], const void *data, size_t n)
{
	if (s->blobs->count) {
		*s->blobs->count += n;
		return;
	}
	bytes_put_u64(s->out, n);
	bytes_put(s->out, name, 16);
	s->held += n;
	if (n && !s->err)
		s->err = s->blobs->put(s->blobs->user, name, data, n);
}

void saver_blob(struct saver *s, const void *data, size_t n)
{
	uint64_t name[2] = { 0 };

	if (!s->blobs->count)
		hash_bytes(data, n, name);
	saver_named_blob(s, name, data, n);
}

static int by_key(const void *a, const void *b)
{
	const struct table_entry *l = a, *r = b;

	return (l->key > r->key) - (l->key < r->key);
}

/* Entries of a table in ascending order of keys, so that equal tables are equal bytes. */
static struct table_entry *sorted(struct saver *s, const struct table *t)
{
	struct table_entry *entries = malloc((t->n + 1) * sizeof(*entries));
	size_t n = 0;

	if (!entries) {
		s->err = err_report(ERR_SYSTEM, s->x->path, "out of memory");
		bytes_put_u64(s->out, 0);
		return NULL;
	}
	for (size_t i = 0; i < t->room; i++)
		if (t->entries[i].value)
			entries[n++] = t->entries[i];
	qsort(entries, n, sizeof(*entries), by_key);
	bytes_put_u64(s->out, n);
	return entries;
}

void saver_table(struct saver *s, const struct table *t, const struct snapshot_table *how)
{
	struct table_entry *e = sorted(s, t);
	size_t n = e ? t->n : 0;

	for (size_t i = 0; i < n; i++) {
		if (how->what)
			saver_section(s, how->what, e[i].key);
		bytes_put_u64(s->out, e[i].key);
		how->put(s, e[i].value);
	}
	free(e);
}

static void put_number(struct saver *s, void *value)
{
	bytes_put_u64(s->out, (uintptr_t)value);
}

/* ---- loading ---- */

int loader_is_bad(const struct loader *l)
{
	return l->in.failed || l->err;
}

void *loader_alloc(struct loader *l, size_t n)
{
	void *out = loader_is_bad(l) ? NULL : calloc(1, n ? n : 1);

	if (!out && !loader_is_bad(l))
		l->err = err_report(ERR_SYSTEM, l->x->path, "out of memory");
	return out;
}

uint64_t loader_count(struct loader *l, size_t bytes)
{
	uint64_t n = cursor_u64(&l->in);

	if (n > MAX_OBJECTS || n * bytes > (uint64_t)(l->in.end - l->in.p))
		l->in.failed = 1;
	return l->in.failed ? 0 : n;
}

uint8_t *loader_blob(struct loader *l, size_t *n)
{
	uint64_t size = cursor_u64(&l->in), name[2];
	uint8_t *data;

	*n = 0;
	cursor_copy(&l->in, name, sizeof(name));
	if (loader_is_bad(l) || size == 0)
		return NULL;
	data = size < (uint64_t)1 << 40 ? l->blobs->get(l->blobs->user, name, (size_t)size) : NULL;
	if (data)
		*n = (size_t)size;
	else
		l->in.failed = 1;
	return data;
}

void loader_table(struct loader *l, struct table *t, const struct snapshot_table *how)
{
	uint64_t n = loader_count(l, how->least_bytes);

	for (uint64_t i = 0; i < n && !loader_is_bad(l); i++) {
		uint64_t key = cursor_u64(&l->in);
		void *value = how->get(l);

		if (!value)
			continue;
		if (table_find(t, key)) {
			l->in.failed = 1;
			how->drop(value);
		} else if (table_set(t, key, value)) {
			l->err = ERR_SYSTEM;
			how->drop(value);
		}
	}
}

static void *get_number(struct loader *l)
{
	return (void *)(uintptr_t)cursor_u64(&l->in);
}

static void drop_number(void *value)
{
	(void)value;
}

const struct snapshot_table snapshot_numbers = { NULL, 16, put_number, get_number, drop_number };
