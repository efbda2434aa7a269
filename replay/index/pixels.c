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
#include "base/part.h"
#include "replay/gl/surface/frames.h"
#include "replay/index/index_file.h"

#define NAMES "*-*-*.index"               /* as path_of makes them */
#define MOST_BYTES ((uint64_t)256 << 20) /* of a checkpoint */
#define MOST_ALL ((uint64_t)1 << 30)     /* of all */

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

/* @return 0: the path is too long */
static int path_of(const struct pixels *p, uint64_t frame, char out[PATH_MAX])
{
	const int n = snprintf(out, PATH_MAX, "%s/%.32s-%016" PRIx64 "-%" PRIu64 ".index", p->folder, p->trace,
	                       p->maker, frame);

	return n > 0 && n < PATH_MAX;
}

/* --- Finding ----------------------------------------------------------------------------------------------------- */

int pixels_find(const struct pixels *p, uint64_t frame, uint64_t *found)
{
	char prefix[64];
	const int n = snprintf(prefix, sizeof(prefix), "%.32s-%016" PRIx64 "-", p->trace, p->maker);
	DIR *all = p->folder ? opendir(p->folder) : NULL;
	int any = 0;

	for (struct dirent *e; all && (e = readdir(all));) {
		uint64_t number;
		int end = 0;

		if (strncmp(e->d_name, prefix, (size_t)n) != 0 ||
		    sscanf(e->d_name + n, "%" SCNu64 ".index%n", &number, &end) != 1 || !end || e->d_name[n + end] ||
		    number > frame || (any && number < *found))
			continue;
		*found = number;
		any = 1;
	}
	if (all)
		closedir(all);
	return any;
}

int pixels_restore(const struct pixels *p, uint64_t frame, struct trace_reader *reader, struct gls_exec *x)
{
	struct index *index = NULL;
	char path[PATH_MAX];
	int rc;

	if (!path_of(p, frame, path))
		return ERR_INPUT;
	rc = index_create(&index, p->path, p->trace);
	if (!rc)
		rc = index_open_file(index, path) ? index_restore(index, frame, reader, x) : ERR_INPUT;
	index_close(&index);
	if (rc == ERR_INPUT)
		unlink(path);
	return rc;
}

/* --- Keeping ----------------------------------------------------------------------------------------------------- */

/* index: with its file, which is begun. @return 0; 1: not worth its bytes, or the file is lost; ERR_SYSTEM
 * (reported) */
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

int pixels_keep(const struct pixels *p, struct trace_reader *reader, struct gls_exec *x)
{
	char path[PATH_MAX], part[PATH_MAX];
	struct index *index = NULL;
	int rc;

	if (!p->folder || !path_of(p, x->frame, path) || access(path, F_OK) == 0 || folder_try(p->folder))
		return 0;
	if (!gls_frame_settle(x))
		return x->failed;
	rc = index_create(&index, p->path, p->trace);
	if (!rc && index_begin_file(index, path, part)) {
		rc = write_index(index, reader, x);
		if (!rc)
			rename(part, path);
		part_drop(part);
	}
	index_close(&index);
	folder_keep_bound(p->folder, NAMES, MOST_ALL, MOST_ALL);
	return rc < 0 ? rc : 0;
}
