/* Scans a trace for its index, and decides which checkpoints are worth their size. */
#include "replay/index/index_build.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/part.h"
#include "base/progress.h"
#include "capture/format/call.h"
#include "replay/index/index_file.h"
#include "replay/index/pack.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/play/player.h"
#include "replay/programs/program.h"
#include "replay/trace/cut.h"

#define SPACING_BYTES ((uint64_t)1 << 20) /* bytes of calls between checkpoints: some milliseconds */
#define ALWAYS_BYTES ((uint64_t)256 << 10) /* size that an index may always have, however small the trace */

/* ---- checkpoints ---- */

int index_add_checkpoint(struct index *index, struct trace_reader *reader, struct gls_exec *x, uint64_t most,
                         int (*save)(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out))
{
	struct snapshot_blobs blobs = index_blobs(index);
	struct index_checkpoint c = { .frame = x->frame };
	struct bytes state = { .n = 0 };
	int rc;

	index->added = 0;
	index->most = most;
	if (!trace_reader_place(reader, &c.place))
		return 0;
	rc = save(x, &blobs, &state);
	if (rc == 0) {
		hash_bytes(state.data, state.n, c.name);
		c.bytes = state.n;
		rc = index_stage_blob(index, c.name, state.data, state.n);
	}
	if (rc == 0)
		rc = index->added <= index->most ? index_keep_staged(index) : 1;
	if (rc == 0 && index->file) {
		rc = MEMORY_GROW(index->checkpoints, index->room_checkpoints, index->n_checkpoints + 1);
		if (rc == 0)
			index->checkpoints[index->n_checkpoints++] = c;
	}
	index_drop_staged(index);
	free(state.data);
	return rc < 0 ? rc : 0;
}

/* Add a checkpoint if it is worth its size (index_build.h). */
static int add_checkpoint(struct index *index, struct player *p)
{
	const uint64_t most = trace_reader_offset(p->reader) + ALWAYS_BYTES;

	return index_add_checkpoint(index, p->reader, p->exec, most > index->end ? most - index->end : 0, snapshot_save);
}

static int add_frame(struct index *index, struct player *p)
{
	struct trace_place place;

	trace_reader_place(p->reader, &place);
	if (MEMORY_GROW(index->frames, index->room_frames, index->n_frames + 1))
		return ERR_SYSTEM;
	index->frames[index->n_frames++] = (struct index_frame){ place.number - 1, place.offset, p->exec->time_ns };
	return 0;
}

/* The entry of a command, created if necessary. NULL: out of memory */
static struct index_lack *find_lack(struct index *index, const char *name)
{
	struct index_lack *l;

	for (size_t i = 0; i < index->n_lacks; i++)
		if (strncmp(index->lacks[i].name, name, sizeof(l->name) - 1) == 0)
			return &index->lacks[i];
	if (MEMORY_GROW(index->lacks, index->room_lacks, index->n_lacks + 1))
		return NULL;
	l = &index->lacks[index->n_lacks++];
	memset(l, 0, sizeof(*l));
	snprintf(l->name, sizeof(l->name), "%s", name);
	return l;
}

/* Note that a command is not executed. `seen` differs from that of the previous frame if this frame calls it. */
static int note_lack(struct index *index, const char *name, const char *why, uint64_t seen, int stays)
{
	const uint64_t frame = index->n_frames - 1;
	struct index_lack *l = find_lack(index, name);

	if (!l || l->seen == seen)
		return l ? 0 : ERR_SYSTEM;
	snprintf(l->why, sizeof(l->why), "%s", why ? why : "");
	l->first = l->seen ? l->first : frame;
	l->last = frame;
	l->seen = seen;
	l->stays = (uint64_t)stays;
	return 0;
}

/*
 * The part missing from draws by a program that is not run and may draw again, because it stays current across frames;
 * NULL: none. command: receives the call that made it current
 */
static const char *program_lack(const struct gls_exec *x, const char **command)
{
	for (size_t i = 0; i < x->n_contexts; i++) {
		const char *lack = gls_program_lack(&x->contexts[i]->state);

		*command = x->contexts[i]->state.program ? "glUseProgram" : "glProgramStringARB";
		if (lack)
			return lack;
	}
	*command = "glUseProgram";
	return NULL;
}

/* Note what the frame that has just ended lacks. programs: its count at the end of the previous frame */
static int note_lacks(struct index *index, const struct gls_exec *x, uint64_t *programs)
{
	const struct gls_counts *counts = &x->counts;
	const char *command, *lack = program_lack(x, &command);
	int rc = 0;

	if (lack || counts->programs_used != *programs)
		rc = note_lack(index, command, lack ? lack : counts->programs_why, index->n_frames, 0);
	*programs = counts->programs_used;
	for (unsigned i = 0; i < n_gls_commands && !rc; i++) {
		const uint32_t kind = gls_commands[i].kind;

		if (counts->unsupported[i] && counts->why[i] != gls_needs_renderer)
			rc = note_lack(index, gls_commands[i].name, counts->why[i], counts->unsupported[i],
			               kind != GLS_KIND_ARRAY && kind != GLS_KIND_VERTEX && kind != GLS_KIND_INSIDE);
	}
	for (size_t i = 0; i < counts->unknown.room && !rc; i++)
		if (counts->unknown.entries[i].value)
			rc = note_lack(index, ((const struct call_sig *)(uintptr_t)counts->unknown.entries[i].key)->name, NULL,
			               (uintptr_t)counts->unknown.entries[i].value, 1);
	return rc;
}

/* The minimum distance between checkpoints: measuring a large state takes time as well. */
static uint64_t spacing(uint64_t state_bytes)
{
	return state_bytes / 4 > SPACING_BYTES ? state_bytes / 4 : SPACING_BYTES;
}

/*
 * The minimum distance from a checkpoint to a larger one. Restoring one more byte of state takes as long as replaying a
 * byte and a quarter of calls (medians over recordings of eight programs).
 */
static uint64_t soonest(uint64_t grown_bytes)
{
	return grown_bytes + grown_bytes / 4;
}

/* Measure the size of the state that a checkpoint would save. */
static int measure(struct player *p, uint64_t *bytes)
{
	const struct snapshot_blobs scale = { .count = bytes };
	struct bytes state = { .n = 0 };
	int rc;

	*bytes = 0;
	rc = snapshot_save(p->exec, &scale, &state);
	*bytes += state.n;
	free(state.data);
	return rc < 0 ? rc : 0;
}

static int scan(struct index *index, struct player *p)
{
	uint64_t next = SPACING_BYTES; /* earliest position of the next checkpoint */
	uint64_t last = 0, kept = 0, programs = 0, bytes; /* position and state size of the last checkpoint; current
	                                                     state size */
	struct scene *none;
	int rc;

	while ((rc = player_try_frame(p, 0, &none)) == 1) {
		rc = add_frame(index, p);
		if (!rc)
			rc = note_lacks(index, p->exec, &programs);
		if (!rc && index->file && index->frames[index->n_frames - 1].offset >= next) {
			uint64_t offset = index->frames[index->n_frames - 1].offset;

			rc = measure(p, &bytes);
			next = last + soonest(bytes > kept ? bytes - kept : 0);
			if (!rc && offset >= next) {
				rc = add_checkpoint(index, p);
				last = offset;
				kept = bytes;
				next = offset + spacing(bytes);
			}
		}
		if (rc)
			return rc;
	}
	index->calls = p->exec->n_calls;
	index->damaged = rc == ERR_INPUT;
	index->cut_after = trace_reader_cut_after(p->reader);
	return rc == ERR_INPUT && index->n_frames ? 0 : rc;
}

/* ---- the file ---- */

static void put_toc(const struct index *index, struct bytes *out)
{
	bytes_put_u64(out, index->calls);
	bytes_put_u64(out, (uint64_t)index->damaged);
	bytes_put_u64(out, index->cut_after);
	bytes_put_u64(out, index->n_frames);
	bytes_put(out, index->frames, index->n_frames * sizeof(*index->frames));
	bytes_put_u64(out, index->n_checkpoints);
	bytes_put(out, index->checkpoints, index->n_checkpoints * sizeof(*index->checkpoints));
	bytes_put_u64(out, index->n_lacks);
	bytes_put(out, index->lacks, index->n_lacks * sizeof(*index->lacks));
	bytes_put_u64(out, index->n_blobs);
	bytes_put(out, index->blobs, index->n_blobs * sizeof(*index->blobs));
	bytes_put_u64(out, index->n_signatures);
	bytes_put(out, index->signatures, index->n_signatures);
}

int index_write_toc(struct index *index)
{
	struct index_header *h = &index->header;
	struct bytes toc = { .n = 0 };
	char *packed = NULL;
	size_t n;
	int rc = ERR_SYSTEM;

	index_undelta(index->frames, index->n_frames, -1);
	put_toc(index, &toc);
	index_undelta(index->frames, index->n_frames, 1);
	if (toc.failed || !(packed = malloc(pack_room(toc.n))) || pack_blob((const char *)toc.data, toc.n, packed, &n)) {
		rc = index_out_of_memory(index);
		goto done;
	}
	hash_bytes(packed, n, h->toc_hash);
	h->toc_offset = index->end;
	h->toc_packed = n;
	h->toc_bytes = toc.n;
	if (fwrite(packed, 1, n, index->file) == n && fseek(index->file, 0, SEEK_SET) == 0 &&
	    fwrite(h, sizeof(*h), 1, index->file) == 1 && fflush(index->file) == 0 &&
	    ftruncate(fileno(index->file), (off_t)(h->toc_offset + n)) == 0) /* blobs may have been staged and dropped there */
		rc = 0;
	else
		index_lose_file(index);
done:
	free(toc.data);
	free(packed);
	return index->file ? rc : 0;
}

int index_begin_file(struct index *index, const char *path, char part[PATH_MAX])
{
	const struct index_header empty = { .layout = 0 };

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

/* Begin the index file beside the trace, or in the cache folder. path: receives the final name */
static int begin_file(struct index *index, int cached, char path[PATH_MAX], char part[PATH_MAX])
{
	char folder[PATH_MAX];
	struct stat info;

	if (!index_place(index, cached, path))
		return 0;
	if (cached && (!folder_cached("", folder, sizeof(folder)) || folder_try(folder)))
		return 0;
	if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
		return 0;
	return index_begin_file(index, path, part);
}

/* fresh: a player to scan with, or NULL */
static int make(struct index *index, struct player *fresh)
{
	char path[PATH_MAX], part[PATH_MAX];
	double start = progress_clock_s();
	struct player own = { 0 }, *p = fresh ? fresh : &own;
	int kept = begin_file(index, 0, path, part) || begin_file(index, 1, path, part), rc;

	if (!kept)
		err_warn(index->trace, "its index cannot be written, neither beside it nor into the cache folder; the next run "
		         "makes it again");
	rc = fresh ? 0 : player_open(p, index->trace);
	if (!rc)
		rc = trace_reader_hash_begin(p->reader);
	if (!rc)
		rc = scan(index, p);
	if (!rc)
		rc = trace_reader_signatures(p->reader, &index->signatures, &index->n_signatures);
	if (!rc)
		rc = trace_reader_hash_end(p->reader, index->header.whole_hash);
	if (!rc && index->file)
		rc = index_write_toc(index);
	player_close(&own);
	index->build_s = progress_clock_s() - start;
	if (kept && (rc || !index->file)) {
		part_drop(part);
	} else if (kept) {
		const int has_name = rename(part, path) == 0;

		if (!has_name) /* this process can use the index even so */
			err_warn(index->trace, "its index cannot be renamed into place: %s; the next run makes it again", strerror(errno));
		part_drop(part);
		if (has_name && !(index->path = strdup(path)))
			rc = index_out_of_memory(index);
	}
	return rc;
}

int index_open(struct index **out, const char *path, const char *hash, enum index_mode mode, struct player *fresh)
{
	int rc = index_create(out, path, hash);

	if (!rc && mode == INDEX_KEEP && index_load(*out)) {
		if ((*out)->cut_after)
			trace_warn_cut(path, (*out)->cut_after);
		return 0;
	}
	if (rc)
		return rc;
	rc = make(*out, fresh);
	if (rc)
		index_close(out);
	return rc;
}
