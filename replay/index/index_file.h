/*
 * The file of an index, for the code that reads it (index.c), writes it (index_build.c) and compares it
 * (index_check.c).
 *
 * It has a header; blobs, each stored once under the XXH3-128 of its content and Snappy-packed if that saves space; and
 * a table of contents with a checksum, packed the same way. Snapshots are blobs as well. Numbers have native byte
 * order.
 */
#pragma once

#include <stdio.h>

#include "replay/index/index.h"
#include "replay/index/snapshot.h"

#define INDEX_MAGIC "RELIDX6\n" /* the number changes with the file format */

struct index_header {
	char magic[8];
	uint64_t layout;
	uint64_t trace_bytes, trace_mtime_ns;
	char trace_hash[32]; /* hex digits, without a terminator */
	uint64_t whole_hash[2];
	uint64_t toc_offset, toc_packed, toc_bytes, toc_hash[2]; /* table of contents: position, packed and unpacked size,
	                                                            XXH3-128 of the packed bytes */
};

struct index_blob {
	uint64_t name[2]; /* XXH3-128 of the content */
	uint64_t offset, packed; /* position in the file; packed size, bytes */
};

struct index_checkpoint {
	uint64_t frame;
	struct trace_place place;
	uint64_t name[2], bytes; /* name of the snapshot's blob; its unpacked size */
};

struct index_frame {
	uint64_t call, offset, time_ns;
};

struct index {
	char *trace, *path;
	FILE *file; /* holds the blobs; NULL: cannot be written */
	uint64_t end; /* end of the blobs written so far */
	struct index_header header;
	struct index_blob *blobs;
	struct table known; /* low half of a name -> 1 + number of its blob */
	size_t n_blobs, room_blobs;
	struct index_checkpoint *checkpoints;
	size_t n_checkpoints, room_checkpoints;
	struct index_frame *frames;
	size_t n_frames, room_frames;
	struct index_lack *lacks;
	size_t n_lacks, room_lacks;
	uint64_t calls, cut_after; /* cut_after: the last call of a trace that is cut short; 0: it is whole */
	int damaged;
	uint8_t *signatures;
	size_t n_signatures;
	double build_s; /* 0: loaded from a file */
	struct index *base; /* an index of the same trace, borrowed: blobs that it has are not stored again; NULL:
	                       none */

	/* The checkpoint being added. Its new blobs are written after the others, and are kept if it is. */
	uint64_t added; /* size of the new blobs */
	uint64_t most;  /* upper bound on `added`: above it the checkpoint is not worth its size */
	struct index_blob *staged;
	size_t n_staged, room_staged;
	struct table waiting; /* as `known`, for staged blobs */
	char *packed; /* room for one packed blob */
	size_t room_packed;
};

/** Report that memory ran out. @return ERR_SYSTEM */
int index_out_of_memory(const struct index *index);

/** The file can no longer be written (reported): the index continues in memory, without checkpoints. */
void index_lose_file(struct index *index);

/** Replace numbers of frames by their differences, which pack well (sign -1), or restore them (sign 1). */
void index_undelta(struct index_frame *frames, size_t n, int sign);

/**
 * Open the file of an index without contents. @return 1; 0: there is none, or it is out of date or damaged (reported)
 */
int index_open_file(struct index *index, const char *path);

/** Start an unfinished file (base/part.h). @param part  receives its name @return 1; 0: none can be written there */
int index_begin_file(struct index *index, const char *path, char part[PATH_MAX]);

/**
 * Add a checkpoint of the current state, if it takes no more than `most` bytes.
 * @param save  snapshot_save or snapshot_save_pixels
 * @return 0 or ERR_SYSTEM (reported)
 */
int index_add_checkpoint(struct index *index, struct trace_reader *reader, struct gls_exec *x, uint64_t most,
                         int (*save)(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out));

/**
 * Write the table of contents and the header, which completes the file. @return 0 or ERR_SYSTEM (reported). A lost file
 * is not an error
 */
int index_write_toc(struct index *index);

/* ---- blobs ---- */

/** Access to the blobs of snapshots; `put` stages them. */
struct snapshot_blobs index_blobs(struct index *index);

/** Register a blob that is in the file. @return 0 or ERR_SYSTEM (reported) */
int index_add_blob(struct index *index, const struct index_blob *blob);

/**
 * Pack a blob that is not in the file yet, and write it after those staged before. @return 0 or ERR_SYSTEM (reported)
 */
int index_stage_blob(void *index, const uint64_t name[2], const void *data, size_t n);

/** Add the staged blobs to the others. @return 0 or ERR_SYSTEM (reported) */
int index_keep_staged(struct index *index);

/** Drop staged blobs; the next write overwrites them. */
void index_drop_staged(struct index *index);

/** The n bytes of a blob, to be freed with free(); NULL: missing or damaged (reported) */
uint8_t *index_get_blob(void *index, const uint64_t name[2], size_t n);
