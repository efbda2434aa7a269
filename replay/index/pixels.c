#include "replay/index/pixels.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/folder_bound.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/part.h"
#include "replay/index/index_file.h"

#define NAMES "*-*-*.index" /* matches the names that path_of makes */
/* Size limits, bytes: of one checkpoint, of all of a trace, and of all in the folder. */
#define MOST_BYTES ((uint64_t)256 << 20)
#define MOST_TRACE ((uint64_t)512 << 20)
#define MOST_ALL ((uint64_t)1 << 30)

uint64_t pixels_maker(const char *device)
{
	struct stat own = { 0 };
	uint64_t maker[2];
	char text[400];
	int n;

	stat("/proc/self/exe", &own);
	n = snprintf(text, sizeof(text), "%lld %lld.%ld %s", (long long)own.st_size, (long long)own.st_mtim.tv_sec,
	             own.st_mtim.tv_nsec, device);
	hash_bytes(text, (size_t)n < sizeof(text) ? (size_t)n : sizeof(text), maker);
	return maker[0];
}

/* Path of a frame's checkpoint. @return 1; 0: it is too long */
static int path_of(const struct pixels *p, uint64_t frame, char out[PATH_MAX])
{
	const int n = snprintf(out, PATH_MAX, "%s/%.32s-%016" PRIx64 "-%" PRIu64 ".index", p->folder, p->trace,
	                       p->maker, frame);

	return n > 0 && n < PATH_MAX;
}

/* --- Finding ----------------------------------------------------------------------------------------------------- */

/* 1 if a file in the folder is a checkpoint of this trace and maker. frame: receives its frame */
static int is_own(const struct pixels *p, const char *name, uint64_t *frame)
{
	char prefix[64];
	const int n = snprintf(prefix, sizeof(prefix), "%.32s-%016" PRIx64 "-", p->trace, p->maker);
	int end = 0;

	return strncmp(name, prefix, (size_t)n) == 0 && sscanf(name + n, "%" SCNu64 ".index%n", frame, &end) == 1 && end &&
	       !name[n + end];
}

int pixels_find(const struct pixels *p, uint64_t frame, uint64_t *found)
{
	DIR *all = p->folder ? opendir(p->folder) : NULL;
	int any = 0;

	for (struct dirent *e; all && (e = readdir(all));) {
		uint64_t number;

		if (!is_own(p, e->d_name, &number) || number > frame || (any && number < *found))
			continue;
		*found = number;
		any = 1;
	}
	if (all)
		closedir(all);
	return any;
}

int pixels_restore(const struct pixels *p, struct index *base, uint64_t frame, struct trace_reader *reader,
                   struct gls_exec *x)
{
	struct index *index = NULL;
	char path[PATH_MAX];
	int rc;

	if (!path_of(p, frame, path))
		return ERR_INPUT;
	rc = index_create(&index, p->path, p->trace);
	if (!rc)
		index->base = base;
	if (!rc)
		rc = index_open_file(index, path) ? index_restore(index, frame, reader, x) : ERR_INPUT;
	index_close(&index);
	if (rc == ERR_INPUT)
		unlink(path);
	return rc;
}

/* --- Keeping ----------------------------------------------------------------------------------------------------- */

static int by_number(const void *a, const void *b)
{
	const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

	return (x > y) - (x < y);
}

/* Frames of all checkpoints of this trace and maker, ascending, and their bytes. @return to be freed; NULL: none, or no
 * memory */
static uint64_t *list_own(const struct pixels *p, size_t *n, uint64_t *bytes)
{
	DIR *all = opendir(p->folder);
	uint64_t *list = NULL, frame;
	size_t room = 0;
	struct stat info;

	*n = 0;
	*bytes = 0;
	for (struct dirent *e; all && (e = readdir(all));) {
		if (!is_own(p, e->d_name, &frame) || fstatat(dirfd(all), e->d_name, &info, 0) ||
		    MEMORY_GROW(list, room, *n + 1))
			continue;
		*bytes += (uint64_t)info.st_size;
		list[(*n)++] = frame;
	}
	if (all)
		closedir(all);
	if (list)
		qsort(list, *n, sizeof(*list), by_number);
	return list;
}

/*
 * If the checkpoints of a trace are too large, delete every second one: the rest stay close to each other, whichever
 * frames they began at.
 */
static void thin_out(const struct pixels *p)
{
	char path[PATH_MAX];
	uint64_t bytes;
	size_t n;
	uint64_t *list = list_own(p, &n, &bytes);

	for (size_t i = 1; i < n && bytes > MOST_TRACE; i += 2)
		if (path_of(p, list[i], path))
			unlink(path);
	free(list);
}

/* Write an index of one checkpoint; its file is begun. @return 0; 1: not worth its size, or the file is lost;
 * ERR_SYSTEM (reported) */
static int write_index(struct index *index, struct trace_reader *reader, struct gls_exec *x)
{
	int rc = index_add_checkpoint(index, reader, x, MOST_BYTES, snapshot_save_pixels);

	if (!rc && (!index->file || !index->n_checkpoints))
		return 1;
	if (!rc)
		rc = trace_reader_signatures(reader, &index->signatures, &index->n_signatures);
	if (!rc)
		rc = index_write_toc(index);
	return rc || index->file ? rc : 1;
}

int pixels_lacks(const struct pixels *p, uint64_t frame)
{
	char path[PATH_MAX];

	return p->folder && path_of(p, frame, path) && access(path, F_OK) != 0 && folder_try(p->folder) == 0;
}

int pixels_keep(const struct pixels *p, struct index *base, struct trace_reader *reader, struct gls_exec *x)
{
	char path[PATH_MAX], part[PATH_MAX];
	struct index *index = NULL;
	int rc;

	if (!path_of(p, x->frame, path))
		return 0;
	rc = index_create(&index, p->path, p->trace);
	if (!rc)
		index->base = base;
	if (!rc && index_begin_file(index, path, part)) {
		rc = write_index(index, reader, x);
		if (!rc)
			rename(part, path);
		part_drop(part);
	}
	index_close(&index);
	thin_out(p);
	folder_keep_bound(p->folder, NAMES, MOST_ALL, MOST_ALL);
	return rc < 0 ? rc : 0;
}
