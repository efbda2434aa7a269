/*
 * The file of an index, as those see it who read it (index.c), write it (index_build.c) and compare it (index_check.c).
 *
 * A header; blobs, each once, under the XXH3-128 of their content, Snappy-packed where that saves something; a table of
 * contents with a checksum, packed alike. Snapshots are blobs as well. Numbers are as this machine has them.
 */
#pragma once

#include <stdio.h>

#include "replay/index/index.h"
#include "replay/index/snapshot.h"

#define INDEX_MAGIC "RELIDX5\n" /* the number changes with this file's form */

struct index_header {
	char magic[8];
	uint64_t layout;
	uint64_t trace_bytes, trace_mtime_ns;
	char trace_hash[32]; /* hex digits, not ended */
	uint64_t whole_hash[2];
	uint64_t toc_offset, toc_packed, toc_bytes, toc_hash[2];
};

struct index_blob {
	uint64_t name[2], offset, packed;
};

struct index_checkpoint {
	uint64_t frame;
	struct trace_place place;
	uint64_t name[2], bytes; /* of the snapshot */
};

struct index_frame {
	uint64_t call, offset, time_ns;
};

struct index {
	char *trace, *path;
	FILE *file; /* blobs; NULL: nowhere to write them */
	uint64_t end; /* of the blobs written so far */
	struct index_header header;
	struct index_blob *blobs;
	struct table known; /* low half of a name -> number of its blob + 1 */
	size_t n_blobs, room_blobs;
	struct index_checkpoint *checkpoints;
	size_t n_checkpoints, room_checkpoints;
	struct index_frame *frames;
	size_t n_frames, room_frames;
	struct index_lack *lacks;
	size_t n_lacks, room_lacks;
	uint64_t calls;
	int damaged;
	uint8_t *signatures;
	size_t n_signatures;
	double build_s; /* 0: it was there */
	struct index *base; /* of the same trace, borrowed: blobs that it has are not kept again; NULL: none */

	/* The checkpoint that is being weighed. Its new blobs are written behind the others; they stay if it does. */
	uint64_t added; /* their bytes */
	uint64_t most;  /* upper bound on those: more are not worth a checkpoint */
	struct index_blob *staged;
	size_t n_staged, room_staged;
	struct table waiting; /* as known, of those */
	char *packed; /* room for one */
	size_t room_packed;
};

/** Report that there is no memory. @return ERR_SYSTEM */
int index_out_of_memory(const struct index *index);

/** The file cannot be written any more (said): the index goes on in memory, without checkpoints. */
void index_lose_file(struct index *index);

/** Frames to differences (sign -1), which are small numbers that pack well, and back (1). */
void index_undelta(struct index_frame *frames, size_t n, int sign);

/** Open the file of an index that knows nothing yet. @return 1; 0: there is none, or it is stale or damaged (said) */
int index_open_file(struct index *index, const char *path);

/** Begin an unfinished file (base/part.h) to write into. @param part  receives its name @return 1; 0: none can be
 * written there */
int index_begin_file(struct index *index, const char *path, char part[PATH_MAX]);

/**
 * Add a checkpoint of the state as it is, where that does not take more than so many bytes.
 * @param save  snapshot_save or snapshot_save_pixels
 * @return 0 or ERR_SYSTEM (reported)
 */
int index_add_checkpoint(struct index *index, struct trace_reader *reader, struct gls_exec *x, uint64_t most,
                         int (*save)(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out));

/** Write the table of contents and the header; then the file is whole. @return 0 or ERR_SYSTEM (reported). A file that
 * is lost is no error */
int index_write_toc(struct index *index);

/* ---- blobs ---- */

/** Blobs of snapshots: put stages them. */
struct snapshot_blobs index_blobs(struct index *index);

/** Know a blob that is in the file. @return 0 or ERR_SYSTEM (reported) */
int index_add_blob(struct index *index, const struct index_blob *blob);

/** Pack a blob that is not there yet, and write it behind those staged before. @return 0 or ERR_SYSTEM (reported) */
int index_stage_blob(void *index, const uint64_t name[2], const void *data, size_t n);

/** Staged blobs join the others. @return 0 or ERR_SYSTEM (reported) */
int index_keep_staged(struct index *index);

/** Forget staged blobs: what is written next goes over them. */
void index_drop_staged(struct index *index);

/** The n bytes of a blob, to be freed with free(); NULL: they are not there, or damaged (reported) */
uint8_t *index_get_blob(void *index, const uint64_t name[2], size_t n);
