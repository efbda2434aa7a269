#include "replay/index/index.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/progress.h"
#include "replay/trace/hash.h"
#include "replay/index/pack.h"
#include "replay/replay.h"
#include "replay/index/snapshot.h"

#define MAGIC "RELIDX3\n" /* the number changes with this file's form */
#define SPACING_BYTES ((uint64_t)1 << 20) /* of calls between checkpoints: some milliseconds */
#define ALWAYS_BYTES ((uint64_t)256 << 10) /* an index may have so many, however small the trace */
#define MAX_BLOB ((uint64_t)1 << 40)

struct header {
	char magic[8];
	uint64_t layout;
	uint64_t trace_bytes, trace_mtime_ns;
	char trace_hash[32]; /* hex digits, not ended */
	uint64_t whole_hash[2];
	uint64_t toc_offset, toc_packed, toc_bytes, toc_hash[2];
};

struct blob {
	uint64_t name[2], offset, packed;
};

struct checkpoint {
	uint64_t frame;
	struct trace_place place;
	uint64_t name[2], bytes; /* of the snapshot */
};

struct frame_end {
	uint64_t call, offset;
};

struct index {
	char *trace, *path;
	FILE *file; /* blobs; NULL: nowhere to write them */
	uint64_t end; /* of the blobs written so far */
	struct header header;
	struct blob *blobs;
	struct table known; /* low half of a name -> number of its blob + 1 */
	size_t n_blobs, room_blobs;
	struct checkpoint *checkpoints;
	size_t n_checkpoints, room_checkpoints;
	struct frame_end *frames;
	size_t n_frames, room_frames;
	uint64_t calls;
	int damaged;
	uint8_t *signatures;
	size_t n_signatures;
	double build_s;
	uint64_t added; /* bytes of the state that was looked at last that are new */
	uint64_t most;  /* such that a checkpoint is worth */
	struct blob *staged; /* its new blobs: written behind the others, which they join if it is */
	size_t n_staged, room_staged;
	struct table waiting; /* low half of a name -> number of its staged blob + 1 */
	char *packed; /* room for one */
	size_t room_packed;
};

static int out_of_memory(const struct index *index)
{
	return err_report(ERR_SYSTEM, index->trace, "out of memory for its index");
}

/* --- Blobs --------------------------------------------------------------------------------------------------------- */

static const struct blob *find_blob(const struct index *index, const uint64_t name[2])
{
	uint64_t key = name[0];
	uintptr_t number;

	for (; (number = (uintptr_t)table_find(&index->known, key)); key++)
		if (memcmp(index->blobs[number - 1].name, name, 16) == 0)
			return &index->blobs[number - 1];
	return NULL;
}

static int add_blob(struct index *index, const struct blob *blob)
{
	uint64_t key = blob->name[0];

	while (table_find(&index->known, key))
		key++;
	if (MEMORY_GROW(index->blobs, index->room_blobs, index->n_blobs + 1))
		return ERR_SYSTEM;
	index->blobs[index->n_blobs++] = *blob;
	return table_set(&index->known, key, (void *)(uintptr_t)index->n_blobs);
}

/* The file cannot be written any more: the index goes on in memory, without checkpoints. */
static void lose_file(struct index *index)
{
	err_warn(index->trace, "its index cannot be written: %s; the next run makes it again", strerror(errno));
	fclose(index->file);
	index->file = NULL;
	index->n_checkpoints = 0;
}

static int is_kept(const struct index *index, const uint64_t name[2])
{
	uint64_t key = name[0];
	uintptr_t number;

	if (find_blob(index, name))
		return 1;
	for (; (number = (uintptr_t)table_find(&index->waiting, key)); key++)
		if (memcmp(index->staged[number - 1].name, name, 16) == 0)
			return 1;
	return 0;
}

static int have_blob(void *user, const uint64_t name[2])
{
	return is_kept(user, name);
}

/* Pack a blob that is not there yet, and write it behind those staged before. */
static int stage_blob(void *user, const uint64_t name[2], const void *data, size_t n)
{
	struct index *index = user;
	struct blob blob = { { name[0], name[1] }, index->end + index->added, 0 };
	uint64_t key = name[0];

	if (!index->file || index->added > index->most || is_kept(index, name))
		return 0;
	if (pack_room(n) > index->room_packed) {
		free(index->packed);
		index->room_packed = pack_room(n);
		index->packed = malloc(index->room_packed);
		index->room_packed *= index->packed != NULL;
	}
	while (table_find(&index->waiting, key))
		key++;
	if (!index->packed || pack_blob(data, n, index->packed, &blob.packed))
		return out_of_memory(index);
	if (MEMORY_GROW(index->staged, index->room_staged, index->n_staged + 1) ||
	    table_set(&index->waiting, key, (void *)(uintptr_t)(index->n_staged + 1)))
		return ERR_SYSTEM;
	index->staged[index->n_staged++] = blob;
	index->added += blob.packed;
	if (fwrite(index->packed, 1, blob.packed, index->file) != blob.packed)
		lose_file(index);
	return 0;
}

/* What is written next goes over what is staged. */
static void drop_staged(struct index *index)
{
	if (index->n_staged && index->file && fseeko(index->file, (off_t)index->end, SEEK_SET))
		lose_file(index);
	index->n_staged = 0;
	table_free(&index->waiting);
}

static int keep_staged(struct index *index)
{
	int rc = 0;

	for (size_t i = 0; i < index->n_staged && index->file && !rc; i++)
		rc = add_blob(index, &index->staged[i]);
	index->end += index->added;
	index->n_staged = 0;
	return rc;
}

static uint8_t *get_blob(void *user, const uint64_t name[2], size_t n)
{
	struct index *index = user;
	const struct blob *blob = find_blob(index, name);
	char *packed = NULL, *data = NULL;
	XXH128_hash_t hash;

	if (!blob || !index->file || blob->packed > index->end || !(packed = malloc(blob->packed + 1)) ||
	    pread(fileno(index->file), packed, blob->packed, (off_t)blob->offset) != (ssize_t)blob->packed)
		goto fail;
	data = unpack_blob(packed, blob->packed, n);
	if (!data)
		goto fail;
	packed = data == packed ? NULL : packed;
	hash = XXH3_128bits(data, n);
	if (hash.low64 != name[0] || hash.high64 != name[1])
		goto fail;
	free(packed);
	return (uint8_t *)data;
fail:
	err_report(ERR_INPUT, index->path ? index->path : index->trace, "is damaged: what a checkpoint needs cannot be read");
	free(packed);
	free(data);
	return NULL;
}

static struct snapshot_blobs blobs_of(struct index *index)
{
	return (struct snapshot_blobs){ .put = stage_blob, .have = have_blob, .get = get_blob, .user = index };
}

/* --- Table of contents --------------------------------------------------------------------------------------------- */

static void put_toc(const struct index *index, struct bytes *out)
{
	bytes_put_u64(out, index->calls);
	bytes_put_u64(out, (uint64_t)index->damaged);
	bytes_put_u64(out, index->n_frames);
	bytes_put(out, index->frames, index->n_frames * sizeof(*index->frames));
	bytes_put_u64(out, index->n_checkpoints);
	bytes_put(out, index->checkpoints, index->n_checkpoints * sizeof(*index->checkpoints));
	bytes_put_u64(out, index->n_blobs);
	bytes_put(out, index->blobs, index->n_blobs * sizeof(*index->blobs));
	bytes_put_u64(out, index->n_signatures);
	bytes_put(out, index->signatures, index->n_signatures);
}

static void *get_array(struct cursor *in, size_t *n, size_t size)
{
	uint64_t count = cursor_u64(in);
	const void *from = count <= MAX_BLOB / size ? cursor_get(in, count * size) : NULL;
	void *out = from ? malloc(count * size + 1) : NULL;

	in->failed |= !out;
	*n = out ? (size_t)count : 0;
	return out ? memcpy(out, from, count * size) : NULL;
}

/* Frames follow each other, and so the differences are small numbers that pack well. */
static void undelta(struct frame_end *frames, size_t n, int sign)
{
	if (sign < 0)
		for (size_t i = n; i-- > 1;) {
			frames[i].call -= frames[i - 1].call;
			frames[i].offset -= frames[i - 1].offset;
		}
	else
		for (size_t i = 1; i < n; i++) {
			frames[i].call += frames[i - 1].call;
			frames[i].offset += frames[i - 1].offset;
		}
}

static int get_toc(struct index *index, const void *data, size_t n)
{
	struct cursor in = { data, (const uint8_t *)data + n, 0 };
	size_t n_blobs;
	struct blob *blobs;

	index->calls = cursor_u64(&in);
	index->damaged = cursor_u64(&in) != 0;
	index->frames = get_array(&in, &index->n_frames, sizeof(*index->frames));
	index->checkpoints = get_array(&in, &index->n_checkpoints, sizeof(*index->checkpoints));
	blobs = get_array(&in, &n_blobs, sizeof(*blobs));
	index->signatures = get_array(&in, &index->n_signatures, 1);
	undelta(index->frames, index->n_frames, 1);
	for (size_t i = 0; i < n_blobs && !in.failed; i++)
		in.failed |= add_blob(index, &blobs[i]) != 0;
	free(blobs);
	return in.failed ? ERR_INPUT : 0;
}

/* --- The trace that it is of --------------------------------------------------------------------------------------- */

static int describe_trace(const char *path, const char *hash, struct header *header)
{
	struct stat info;

	if (stat(path, &info))
		return err_report(ERR_INPUT, path, "cannot be read: %s", strerror(errno));
	memset(header, 0, sizeof(*header));
	memcpy(header->magic, MAGIC, sizeof(header->magic));
	header->layout = snapshot_layout();
	header->trace_bytes = (uint64_t)info.st_size;
	header->trace_mtime_ns = (uint64_t)info.st_mtim.tv_sec * 1000000000u + (uint64_t)info.st_mtim.tv_nsec;
	memcpy(header->trace_hash, hash, sizeof(header->trace_hash));
	return 0;
}

/* Is an index with this header one of this trace and build? */
static int is_current(const char *path, const struct header *found, const struct header *wanted)
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

/* --- Opening one that is there ------------------------------------------------------------------------------------- */

static uint8_t *read_toc(FILE *file, const struct header *h)
{
	char *packed = h->toc_packed < MAX_BLOB ? malloc(h->toc_packed + 1) : NULL, *data = NULL;
	XXH128_hash_t hash;

	if (!packed || pread(fileno(file), packed, h->toc_packed, (off_t)h->toc_offset) != (ssize_t)h->toc_packed)
		goto done;
	hash = XXH3_128bits(packed, h->toc_packed);
	if (hash.low64 == h->toc_hash[0] && hash.high64 == h->toc_hash[1] && h->toc_bytes <= MAX_BLOB)
		data = unpack_blob(packed, h->toc_packed, h->toc_bytes);
done:
	if (data != packed)
		free(packed);
	return (uint8_t *)data;
}

/* @return 1 opened; 0 none is there, or it is stale or damaged (said) */
static int open_file(struct index *index, const char *path)
{
	FILE *file = fopen(path, "rb");
	struct header found;
	uint8_t *toc = NULL;

	if (!file)
		return 0;
	if (fread(&found, sizeof(found), 1, file) != 1 || memcmp(found.magic, MAGIC, sizeof(found.magic)) != 0) {
		err_warn(path, "is no index; it is made anew");
	} else if (!is_current(index->trace, &found, &index->header)) {
		err_warn(path, "is of another trace or another build; it is made anew");
	} else if (!(toc = read_toc(file, &found)) || get_toc(index, toc, found.toc_bytes)) {
		err_warn(path, "is damaged; it is made anew");
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

/* --- Making one ---------------------------------------------------------------------------------------------------- */

/* Add a checkpoint if it is worth its bytes (see the head of index.h). */
static int add_checkpoint(struct index *index, struct replay *rp)
{
	struct snapshot_blobs blobs = blobs_of(index);
	struct checkpoint c = { .frame = replay_frame(rp) };
	uint64_t most = trace_reader_offset(replay_reader(rp)) + ALWAYS_BYTES;
	struct bytes state = { .n = 0 };
	XXH128_hash_t hash;
	int rc;

	index->added = 0;
	index->most = most > index->end ? most - index->end : 0;
	if (!trace_reader_place(replay_reader(rp), &c.place))
		return 0;
	rc = snapshot_save(replay_exec(rp), &blobs, &state);
	if (rc == 0) {
		hash = XXH3_128bits(state.data, state.n);
		c.name[0] = hash.low64;
		c.name[1] = hash.high64;
		c.bytes = state.n;
		rc = stage_blob(index, c.name, state.data, state.n);
	}
	if (rc == 0)
		rc = index->added <= index->most ? keep_staged(index) : 1;
	if (rc == 0 && index->file) {
		rc = MEMORY_GROW(index->checkpoints, index->room_checkpoints, index->n_checkpoints + 1);
		if (rc == 0)
			index->checkpoints[index->n_checkpoints++] = c;
	}
	drop_staged(index);
	free(state.data);
	return rc < 0 ? rc : 0;
}

static int add_frame(struct index *index, struct replay *rp)
{
	struct trace_place place;

	trace_reader_place(replay_reader(rp), &place);
	if (MEMORY_GROW(index->frames, index->room_frames, index->n_frames + 1))
		return ERR_SYSTEM;
	index->frames[index->n_frames++] = (struct frame_end){ place.number - 1, place.offset };
	return 0;
}

/* How far apart checkpoints stand at least: looking at a large state takes its time as well. */
static uint64_t spacing(uint64_t state_bytes)
{
	return state_bytes / 4 > SPACING_BYTES ? state_bytes / 4 : SPACING_BYTES;
}

/*
 * Calls since the last checkpoint before which there is no other: a byte that the state has grown by takes as long to restore as a
 * byte and a quarter of calls to replay (medians of recordings of eight programs).
 */
static uint64_t soonest(uint64_t grown_bytes)
{
	return grown_bytes + grown_bytes / 4;
}

/* How large is the state that a checkpoint would keep? */
static int measure(struct replay *rp, uint64_t *bytes)
{
	const struct snapshot_blobs scale = { .count = bytes };
	struct bytes state = { .n = 0 };
	int rc;

	*bytes = 0;
	rc = snapshot_save(replay_exec(rp), &scale, &state);
	*bytes += state.n;
	free(state.data);
	return rc < 0 ? rc : 0;
}

static int scan(struct index *index, struct replay *rp)
{
	uint64_t next = SPACING_BYTES; /* where a checkpoint may be due */
	uint64_t last = 0, kept = 0, bytes; /* where the last one was, the bytes of its state; those of the state now */
	struct scene *none;
	int rc;

	while ((rc = replay_next_frame(rp, 0, &none)) == 1) {
		rc = add_frame(index, rp);
		if (!rc && index->file && index->frames[index->n_frames - 1].offset >= next) {
			uint64_t offset = index->frames[index->n_frames - 1].offset;

			rc = measure(rp, &bytes);
			next = last + soonest(bytes > kept ? bytes - kept : 0);
			if (!rc && offset >= next) {
				rc = add_checkpoint(index, rp);
				last = offset;
				kept = bytes;
				next = offset + spacing(bytes);
			}
		}
		if (rc)
			return rc;
	}
	index->calls = replay_call_count(rp);
	index->damaged = rc == ERR_INPUT;
	return rc == ERR_INPUT && index->n_frames ? 0 : rc;
}

static int write_toc(struct index *index)
{
	struct header *h = &index->header;
	struct bytes toc = { .n = 0 };
	XXH128_hash_t hash;
	char *packed = NULL;
	size_t n;
	int rc = ERR_SYSTEM;

	undelta(index->frames, index->n_frames, -1);
	put_toc(index, &toc);
	undelta(index->frames, index->n_frames, 1);
	if (toc.failed || !(packed = malloc(pack_room(toc.n))) || pack_blob((const char *)toc.data, toc.n, packed, &n)) {
		rc = out_of_memory(index);
		goto done;
	}
	hash = XXH3_128bits(packed, n);
	h->toc_offset = index->end;
	h->toc_packed = n;
	h->toc_bytes = toc.n;
	h->toc_hash[0] = hash.low64;
	h->toc_hash[1] = hash.high64;
	if (fwrite(packed, 1, n, index->file) == n && fseek(index->file, 0, SEEK_SET) == 0 &&
	    fwrite(h, sizeof(*h), 1, index->file) == 1 && fflush(index->file) == 0 &&
	    ftruncate(fileno(index->file), (off_t)(h->toc_offset + n)) == 0) /* blobs may have been staged and dropped there */
		rc = 0;
	else
		lose_file(index);
done:
	free(toc.data);
	free(packed);
	return index->file ? rc : 0;
}

/* Where an index may lie: beside the trace, or in the cache folder. @return 0 where there is no such place */
static int place_of(const struct index *index, int cached, char out[PATH_MAX])
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

/* An unfinished file to write into. @return 1, with its name and the final one; 0: none can be written there */
static int begin_file(struct index *index, int cached, char path[PATH_MAX], char part[PATH_MAX])
{
	const struct header empty = { .layout = 0 };
	struct stat info;

	if (!place_of(index, cached, path))
		return 0;
	if (cached && folder_make_for(path))
		return 0;
	if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
		return 0;
	if (part_begin(path, part, PATH_MAX))
		return 0;
	index->file = fopen(part, "w+b");
	if (index->file && fwrite(&empty, sizeof(empty), 1, index->file) == 1) {
		index->end = sizeof(empty);
		return 1;
	}
	if (index->file)
		fclose(index->file);
	index->file = NULL;
	part_drop(part);
	return 0;
}

/* fresh: a replay to scan with, or NULL */
static int make(struct index *index, struct replay *fresh)
{
	char path[PATH_MAX], part[PATH_MAX];
	double start = progress_clock_s();
	struct replay *rp = fresh;
	int kept = begin_file(index, 0, path, part) || begin_file(index, 1, path, part), rc;

	if (!kept)
		err_warn(index->trace, "its index cannot be written, neither beside it nor into the cache folder; the next run "
		         "makes it again");
	rc = fresh ? 0 : replay_open(&rp, index->trace);
	if (!rc)
		rc = trace_reader_hash_begin(replay_reader(rp));
	if (!rc)
		rc = scan(index, rp);
	if (!rc)
		rc = trace_reader_signatures(replay_reader(rp), &index->signatures, &index->n_signatures);
	if (!rc)
		rc = trace_reader_hash_end(replay_reader(rp), index->header.whole_hash);
	if (!rc && index->file)
		rc = write_toc(index);
	if (!fresh)
		replay_close(&rp);
	index->build_s = progress_clock_s() - start;
	if (kept && (rc || !index->file)) {
		part_drop(part);
	} else if (kept) {
		/* Where it cannot get its name, this process has it all the same. */
		if (part_finish(part, path) == 0 && !(index->path = strdup(path)))
			rc = out_of_memory(index);
	}
	return rc;
}

/* --- Using it ------------------------------------------------------------------------------------------------------ */

static void forget(struct index *index)
{
	drop_staged(index);
	free(index->staged);
	free(index->packed);
	free(index->blobs);
	free(index->checkpoints);
	free(index->frames);
	free(index->signatures);
	table_free(&index->known);
	index->staged = NULL;
	index->packed = NULL;
	index->room_staged = index->room_packed = 0;
	index->blobs = NULL;
	index->checkpoints = NULL;
	index->frames = NULL;
	index->signatures = NULL;
	index->n_blobs = index->room_blobs = index->n_checkpoints = index->room_checkpoints = 0;
	index->n_frames = index->room_frames = index->n_signatures = 0;
}

int index_open(struct index **out, const char *path, const char *hash, enum index_mode mode, struct replay *fresh)
{
	struct index *index = calloc(1, sizeof(*index));
	char where[PATH_MAX];
	int rc = ERR_SYSTEM;

	*out = NULL;
	if (!index || !(index->trace = strdup(path))) {
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	rc = describe_trace(path, hash, &index->header);
	if (rc)
		goto fail;
	for (int cached = 0; cached < 2 && mode == INDEX_KEEP; cached++) {
		if (place_of(index, cached, where) && open_file(index, where)) {
			*out = index;
			return 0;
		}
		forget(index);
	}
	rc = make(index, fresh);
	if (rc)
		goto fail;
	*out = index;
	return 0;
fail:
	index_close(&index);
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

struct index_facts index_facts(const struct index *index)
{
	return (struct index_facts){ .path = index->path, .frames = index->n_frames, .calls = index->calls,
		                     .damaged = index->damaged, .checkpoints = index->n_checkpoints,
		                     .blobs = index->n_blobs, .build_s = index->build_s,
		                     .bytes = index->file ? index->header.toc_offset + index->header.toc_packed : 0 };
}

void index_frame(const struct index *index, uint64_t frame, uint64_t *call, uint64_t *offset)
{
	*call = frame < index->n_frames ? index->frames[frame].call : 0;
	*offset = frame < index->n_frames ? index->frames[frame].offset : 0;
}

/* Number of the last checkpoint up to a frame, from 1; 0: none. */
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
	struct snapshot_blobs blobs = blobs_of(index);
	size_t number = find_checkpoint(index, checkpoint);
	const struct checkpoint *c = number ? &index->checkpoints[number - 1] : NULL;
	uint8_t *state;
	int rc;

	if (!c || c->frame != checkpoint)
		return err_report(ERR_INPUT, index->trace, "its index has no checkpoint at frame %llu",
		                  (unsigned long long)checkpoint);
	state = get_blob(index, c->name, c->bytes);
	rc = state ? snapshot_load(x, &blobs, state, c->bytes) : ERR_INPUT;
	free(state);
	return rc ? rc : trace_reader_seek(reader, &c->place, index->signatures, index->n_signatures);
}

/* --- Checking it --------------------------------------------------------------------------------------------------- */

/* Blobs of a state that is only compared: their names are in it. */
static int name_only(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

/* Is the state of a replay the one that a checkpoint keeps? */
static int compare_state(struct index *index, const struct checkpoint *c, struct replay *rp, const char *way)
{
	const struct snapshot_blobs nowhere = { .put = name_only };
	struct bytes state = { .n = 0 };
	uint8_t *kept = get_blob(index, c->name, c->bytes);
	size_t at = 0;
	int rc = kept ? snapshot_save(replay_exec(rp), &nowhere, &state) : ERR_INPUT;

	if (rc == 1)
		rc = err_report(ERR_FAILED, index->trace, "checkpoint at frame %llu, %s: cannot be saved there",
		                (unsigned long long)c->frame, way);
	if (rc == 0) {
		while (at < state.n && at < c->bytes && state.data[at] == kept[at])
			at++;
		if (at < state.n || at < c->bytes)
			rc = err_report(ERR_FAILED, index->trace, "checkpoint at frame %llu, %s: byte %zu of %llu differs (%s)",
			                (unsigned long long)c->frame, way, at, (unsigned long long)c->bytes,
			                snapshot_place(replay_exec(rp), at));
	}
	free(kept);
	free(state.data);
	return rc;
}

static int run_to(struct replay *rp, uint64_t frame)
{
	struct scene *none;
	int rc = 1;

	while (rc == 1 && replay_frame(rp) < frame)
		rc = replay_next_frame(rp, 0, &none);
	return rc == 1 ? 0 : rc ? rc : ERR_INPUT;
}

int index_check(struct index *index)
{
	struct replay *straight = NULL, *jumping = NULL;
	int rc = replay_open(&straight, index->trace);

	for (size_t i = 0; i < index->n_checkpoints && !rc; i++) {
		const struct checkpoint *c = &index->checkpoints[i];

		rc = run_to(straight, c->frame);
		if (!rc)
			rc = compare_state(index, c, straight, "replayed");
		if (!rc && jumping) {
			rc = run_to(jumping, c->frame);
			if (!rc)
				rc = compare_state(index, c, jumping, "from the checkpoint before");
		}
		replay_close(&jumping);
		if (!rc)
			rc = replay_open(&jumping, index->trace);
		if (!rc)
			rc = replay_seek(jumping, c->frame);
		rc = rc == 1 ? compare_state(index, c, jumping, "restored") : rc ? rc : ERR_INPUT;
	}
	replay_close(&straight);
	replay_close(&jumping);
	return rc;
}
