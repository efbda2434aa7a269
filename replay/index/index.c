/* Identifies, opens and uses an existing index. */
#include "replay/index/index_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/hash.h"
#include "replay/index/pack.h"
#include "replay/index/snapshot_layout.h"

#define MAX_BYTES ((uint64_t)1 << 40)

int index_place(const struct index *index, int cached, char out[PATH_MAX])
{
	char name[64];
	int n;

	if (cached) {
		snprintf(name, sizeof(name), "%.32s.index", index->header.trace_hash);
		return folder_cached(name, out, PATH_MAX);
	}
	n = snprintf(out, PATH_MAX, "%s.index", index->trace);
	return n > 0 && n < PATH_MAX;
}

/* ---- identifying the trace ---- */

static int describe_trace(const char *path, const char *hash, struct index_header *header)
{
	struct stat info;

	if (stat(path, &info))
		return err_report(ERR_INPUT, path, "cannot be read: %s", strerror(errno));
	memset(header, 0, sizeof(*header));
	memcpy(header->magic, INDEX_MAGIC, sizeof(header->magic));
	header->layout = snapshot_layout();
	header->trace_bytes = (uint64_t)info.st_size;
	header->trace_mtime_ns = (uint64_t)info.st_mtim.tv_sec * 1000000000u + (uint64_t)info.st_mtim.tv_nsec;
	memcpy(header->trace_hash, hash, sizeof(header->trace_hash));
	return 0;
}

/* Does an index with this header match this trace and this layout? */
static int is_current(const char *path, const struct index_header *found, const struct index_header *wanted)
{
	uint64_t whole[2];

	if (memcmp(found->magic, wanted->magic, sizeof(found->magic)) != 0 || found->layout != wanted->layout ||
	    found->trace_bytes != wanted->trace_bytes ||
	    memcmp(found->trace_hash, wanted->trace_hash, sizeof(found->trace_hash)) != 0)
		return 0;
	if (found->trace_mtime_ns == wanted->trace_mtime_ns)
		return 1;
	return hash_whole(path, whole) == 0 && memcmp(whole, found->whole_hash, sizeof(whole)) == 0;
}

/* ---- opening ---- */

static void *get_array(struct cursor *in, size_t *n, size_t size)
{
	uint64_t count = cursor_u64(in);
	const void *from = count <= MAX_BYTES / size ? cursor_get(in, count * size) : NULL;
	void *out = from ? malloc(count * size + 1) : NULL;

	in->failed |= !out;
	*n = out ? (size_t)count : 0;
	return out ? memcpy(out, from, count * size) : NULL;
}

static int get_toc(struct index *index, const void *data, size_t n)
{
	struct cursor in = { data, (const uint8_t *)data + n, 0 };
	size_t n_blobs;
	struct index_blob *blobs;

	index->calls = cursor_u64(&in);
	index->damaged = cursor_u64(&in) != 0;
	index->cut_after = cursor_u64(&in);
	index->frames = get_array(&in, &index->n_frames, sizeof(*index->frames));
	index->checkpoints = get_array(&in, &index->n_checkpoints, sizeof(*index->checkpoints));
	index->lacks = get_array(&in, &index->n_lacks, sizeof(*index->lacks));
	blobs = get_array(&in, &n_blobs, sizeof(*blobs));
	index->signatures = get_array(&in, &index->n_signatures, 1);
	index_undelta(index->frames, index->n_frames, 1);
	for (size_t i = 0; i < n_blobs && !in.failed; i++)
		in.failed |= index_add_blob(index, &blobs[i]) != 0;
	free(blobs);
	return in.failed ? ERR_INPUT : 0;
}

static uint8_t *read_toc(FILE *file, const struct index_header *h)
{
	char *packed = h->toc_packed < MAX_BYTES ? malloc(h->toc_packed + 1) : NULL, *data = NULL;
	uint64_t hash[2];

	if (!packed || pread(fileno(file), packed, h->toc_packed, (off_t)h->toc_offset) != (ssize_t)h->toc_packed)
		goto done;
	hash_bytes(packed, h->toc_packed, hash);
	if (memcmp(hash, h->toc_hash, sizeof(hash)) == 0 && h->toc_bytes <= MAX_BYTES)
		data = unpack_blob(packed, h->toc_packed, h->toc_bytes);
done:
	if (data != packed)
		free(packed);
	return (uint8_t *)data;
}

int index_open_file(struct index *index, const char *path)
{
	FILE *file = fopen(path, "rb");
	struct index_header found;
	uint8_t *toc = NULL;

	if (!file)
		return 0;
	if (fread(&found, sizeof(found), 1, file) != 1 || memcmp(found.magic, INDEX_MAGIC, sizeof(found.magic)) != 0) {
		err_warn(path, "is not an index; rebuilding it");
	} else if (!is_current(index->trace, &found, &index->header)) {
		err_warn(path, "out of date; rebuilding it");
	} else if (!(toc = read_toc(file, &found)) || get_toc(index, toc, found.toc_bytes)) {
		err_warn(path, "damaged; rebuilding it");
	} else {
		index->header = found;
		index->file = file;
		index->end = found.toc_offset;
		index->path = strdup(path);
		free(toc);
		return 1;
	}
	free(toc);
	fclose(file);
	return 0;
}

static void forget(struct index *index)
{
	index_drop_staged(index);
	free(index->staged);
	free(index->packed);
	free(index->blobs);
	free(index->checkpoints);
	free(index->frames);
	free(index->lacks);
	free(index->signatures);
	table_free(&index->known);
	*index = (struct index){ .trace = index->trace, .path = index->path, .file = index->file, .header = index->header,
		                 .base = index->base };
}

int index_load(struct index *index)
{
	char path[PATH_MAX];

	for (int cached = 0; cached < 2; cached++) {
		if (index_place(index, cached, path) && index_open_file(index, path))
			return 1;
		forget(index);
	}
	return 0;
}

int index_create(struct index **out, const char *path, const char *hash)
{
	struct index *index = calloc(1, sizeof(*index));
	int rc = index && (index->trace = strdup(path)) ? 0 : err_report(ERR_SYSTEM, path, "out of memory");

	if (!rc)
		rc = describe_trace(path, hash, &index->header);
	if (rc)
		index_close(&index);
	*out = index;
	return rc;
}

void index_close(struct index **index)
{
	if (!*index)
		return;
	forget(*index);
	if ((*index)->file)
		fclose((*index)->file);
	free((*index)->trace);
	free((*index)->path);
	free(*index);
	*index = NULL;
}

/* ---- using it ---- */

struct index_facts index_facts(const struct index *index)
{
	return (struct index_facts){ .path = index->path, .frames = index->n_frames, .calls = index->calls,
		                     .damaged = index->damaged, .checkpoints = index->n_checkpoints,
		                     .blobs = index->n_blobs, .build_s = index->build_s,
		                     .bytes = index->file ? index->header.toc_offset + index->header.toc_packed : 0 };
}

size_t index_lacks(const struct index *index, const struct index_lack **out)
{
	*out = index->lacks;
	return index->n_lacks;
}

void index_frame(const struct index *index, uint64_t frame, uint64_t *call, uint64_t *offset)
{
	*call = frame < index->n_frames ? index->frames[frame].call : 0;
	*offset = frame < index->n_frames ? index->frames[frame].offset : 0;
}

uint64_t index_frame_time(const struct index *index, uint64_t frame)
{
	return frame < index->n_frames ? index->frames[frame].time_ns : 0;
}

/* The last checkpoint up to a frame, counted from 1; 0: none. */
static size_t find_checkpoint(const struct index *index, uint64_t frame)
{
	size_t lo = 0, hi = index->n_checkpoints;

	while (lo < hi) {
		size_t mid = (lo + hi) / 2;
		if (index->checkpoints[mid].frame <= frame)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

uint64_t index_checkpoint(const struct index *index, uint64_t frame)
{
	size_t number = find_checkpoint(index, frame);

	return number ? index->checkpoints[number - 1].frame : 0;
}

int index_restore(struct index *index, uint64_t checkpoint, struct trace_reader *reader, struct gls_exec *x)
{
	struct snapshot_blobs blobs = index_blobs(index);
	size_t number = find_checkpoint(index, checkpoint);
	const struct index_checkpoint *c = number ? &index->checkpoints[number - 1] : NULL;
	uint8_t *state;
	int rc;

	if (!c || c->frame != checkpoint)
		return err_report(ERR_INPUT, index->trace, "its index has no checkpoint at frame %llu",
		                  (unsigned long long)checkpoint);
	state = index_get_blob(index, c->name, c->bytes);
	rc = state ? snapshot_load(x, &blobs, state, c->bytes) : ERR_INPUT;
	free(state);
	return rc ? rc : trace_reader_seek(reader, &c->place, index->signatures, index->n_signatures);
}
