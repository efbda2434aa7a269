/* Blobs of an index file: finding, staging, keeping and reading them. */
#include "replay/index/index_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"
#include "replay/index/pack.h"

int index_out_of_memory(const struct index *index)
{
	return err_report(ERR_SYSTEM, index->trace, "out of memory for its index");
}

void index_lose_file(struct index *index)
{
	err_warn(index->trace, "its index cannot be written: %s; the next run makes it again", strerror(errno));
	fclose(index->file);
	index->file = NULL;
	index->n_checkpoints = 0;
}

void index_undelta(struct index_frame *frames, size_t n, int sign)
{
	if (sign < 0)
		for (size_t i = n; i-- > 1;) {
			frames[i].call -= frames[i - 1].call;
			frames[i].offset -= frames[i - 1].offset;
			frames[i].time_ns -= frames[i - 1].time_ns;
		}
	else
		for (size_t i = 1; i < n; i++) {
			frames[i].call += frames[i - 1].call;
			frames[i].offset += frames[i - 1].offset;
			frames[i].time_ns += frames[i - 1].time_ns;
		}
}

/* ---- blobs ---- */

/* Find a blob by its name. `t` maps the low half of a name, or the next free key, to 1 + an index in `blobs`. */
static const struct index_blob *find_blob(const struct table *t, const struct index_blob *blobs, const uint64_t name[2])
{
	uint64_t key = name[0];
	uintptr_t number;

	for (; (number = (uintptr_t)table_find(t, key)); key++)
		if (memcmp(blobs[number - 1].name, name, 16) == 0)
			return &blobs[number - 1];
	return NULL;
}

static int set_blob(struct table *t, const uint64_t name[2], size_t number)
{
	uint64_t key = name[0];

	while (table_find(t, key))
		key++;
	return table_set(t, key, (void *)(uintptr_t)(number + 1));
}

int index_add_blob(struct index *index, const struct index_blob *blob)
{
	if (MEMORY_GROW(index->blobs, index->room_blobs, index->n_blobs + 1))
		return ERR_SYSTEM;
	index->blobs[index->n_blobs] = *blob;
	return set_blob(&index->known, blob->name, index->n_blobs++);
}

static int have_blob(void *user, const uint64_t name[2])
{
	const struct index *index = user;

	return find_blob(&index->known, index->blobs, name) || find_blob(&index->waiting, index->staged, name) ||
	       (index->base && have_blob(index->base, name));
}

int index_stage_blob(void *user, const uint64_t name[2], const void *data, size_t n)
{
	struct index *index = user;
	struct index_blob blob = { { name[0], name[1] }, index->end + index->added, 0 };

	if (!index->file || index->added > index->most || have_blob(index, name))
		return 0;
	if (pack_room(n) > index->room_packed) {
		free(index->packed);
		index->room_packed = pack_room(n);
		index->packed = malloc(index->room_packed);
		index->room_packed *= index->packed != NULL;
	}
	if (!index->packed || pack_blob(data, n, index->packed, &blob.packed))
		return index_out_of_memory(index);
	if (MEMORY_GROW(index->staged, index->room_staged, index->n_staged + 1) ||
	    set_blob(&index->waiting, name, index->n_staged))
		return ERR_SYSTEM;
	index->staged[index->n_staged++] = blob;
	index->added += blob.packed;
	if (fwrite(index->packed, 1, blob.packed, index->file) != blob.packed)
		index_lose_file(index);
	return 0;
}

void index_drop_staged(struct index *index)
{
	if (index->n_staged && index->file && fseeko(index->file, (off_t)index->end, SEEK_SET))
		index_lose_file(index);
	index->n_staged = 0;
	table_free(&index->waiting);
}

int index_keep_staged(struct index *index)
{
	int rc = 0;

	for (size_t i = 0; i < index->n_staged && index->file && !rc; i++)
		rc = index_add_blob(index, &index->staged[i]);
	index->end += index->added;
	index->n_staged = 0;
	return rc;
}

uint8_t *index_get_blob(void *user, const uint64_t name[2], size_t n)
{
	struct index *index = user;
	const struct index_blob *blob = find_blob(&index->known, index->blobs, name);
	char *packed = NULL, *data = NULL;
	uint64_t hash[2];

	if (!blob && index->base)
		return index_get_blob(index->base, name, n);
	if (!blob || !index->file || blob->packed > index->end || !(packed = malloc(blob->packed + 1)) ||
	    pread(fileno(index->file), packed, blob->packed, (off_t)blob->offset) != (ssize_t)blob->packed)
		goto fail;
	data = unpack_blob(packed, blob->packed, n);
	if (!data)
		goto fail;
	packed = data == packed ? NULL : packed;
	hash_bytes(data, n, hash);
	if (memcmp(hash, name, sizeof(hash)) != 0)
		goto fail;
	free(packed);
	return (uint8_t *)data;
fail:
	err_report(ERR_INPUT, index->path ? index->path : index->trace, "is damaged: what a checkpoint needs cannot be read");
	free(packed);
	free(data);
	return NULL;
}

struct snapshot_blobs index_blobs(struct index *index)
{
	return (struct snapshot_blobs){ .put = index_stage_blob, .have = have_blob, .get = index_get_blob, .user = index };
}
