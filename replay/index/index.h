/*
 * The index of a trace: the positions of its frames, and checkpoints of the GL state machine. Rendering starts at a
 * checkpoint, so that frame 90 000 costs no more than frame 9.
 *
 * The file is TRACE.index beside the trace, or, if that folder is not writable, HASH.index in $XDG_CACHE_HOME/relume
 * (~/.cache/relume). It identifies the trace by size, time, the hash of its first MiB and the hash of the whole; the
 * last is compared only if the time differs. An index is out of date if the trace or the layout of snapshots
 * (snapshot.h) has changed.
 *
 * This header reads an existing index. index_build.h opens or builds one.
 */
#pragma once

#include <limits.h>

#include "replay/machine/machine.h"
#include "replay/trace/reader.h"

struct index;

/**
 * Create the index of a trace, without contents.
 * @param hash  hash_name
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int index_create(struct index **out, const char *path, const char *hash);

/** Load an existing file. @return 1 loaded; 0 there is none, or it is out of date or damaged (reported) */
int index_load(struct index *index);

/**
 * Path of the index file: beside the trace, or, if cached is 1, in the cache folder. @return 0 if there is no such
 * place
 */
int index_place(const struct index *index, int cached, char out[PATH_MAX]);

/** Free an index, and set it to NULL. */
void index_close(struct index **index);

/* Figures of an index, for reports. */
struct index_facts {
	const char *path;       /* path of the index; NULL: not saved */
	uint64_t frames, calls; /* complete frames; calls executed */
	int damaged;            /* 1: the trace is damaged after its last complete frame */
	uint64_t checkpoints, blobs;
	uint64_t bytes;         /* size of the index */
	double build_s;         /* seconds spent building it; 0: loaded from a file */
};
struct index_facts index_facts(const struct index *index);

/** A command that replays do not execute, or only in part. */
struct index_lack {
	char name[64], why[128]; /* the command; the part that is missing, "": all of it */
	uint64_t first, last;    /* frames that call it */
	uint64_t stays;          /* 1: frames after the last one may lack it as well */
	uint64_t seen;           /* private */
};

/**
 * List the commands that replays do not execute, in order of first use. No scene is built to find them, so what only
 * drawing reveals is not included.
 */
size_t index_lacks(const struct index *index, const struct index_lack **out);

/** Find the call that ends a frame: its number, and its position in the unpacked trace in bytes. */
void index_frame(const struct index *index, uint64_t frame, uint64_t *call, uint64_t *offset);

/** When a frame ended (struct scene); 0: the recording does not say. */
uint64_t index_frame_time(const struct index *index, uint64_t frame);

/** The last frame up to `frame` that has a checkpoint. If none has, 0: replay from the start of the trace. */
uint64_t index_checkpoint(const struct index *index, uint64_t frame);

/**
 * Restore the state at a checkpoint.
 * @param reader  of the same trace; continues with the first call of that frame
 * @param x       as gls_exec_create made it; receives the state
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported). On failure destroy x, and seek the reader before using it again
 */
int index_restore(struct index *index, uint64_t checkpoint, struct trace_reader *reader, struct gls_exec *x);
