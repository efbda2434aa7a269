/*
 * The index of a trace: where its frames are, and checkpoints of the GL state machine. Rendering begins at a
 * checkpoint, so that frame 90 000 costs no more than frame 9.
 *
 * It lies beside the trace as TRACE.index, or, where that folder cannot be written, as HASH.index in
 * $XDG_CACHE_HOME/relume
 * (~/.cache/relume). It names the trace by size, time, the hash of its first MiB and the hash of all of it; the last is
 * compared only where the time differs. An index is stale where the trace or the layout of snapshots (snapshot.h) has
 * changed.
 *
 * This header is about an index that is there. index_build.h opens or makes one.
 */
#pragma once

#include <limits.h>

#include "replay/machine/machine.h"
#include "replay/trace/reader.h"

struct index;

/**
 * An index of a trace that knows nothing yet but which trace.
 * @param hash  hash_name
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int index_create(struct index **out, const char *path, const char *hash);

/** Open the file that is there. @return 1 opened; 0 none is there, or it is stale or damaged (said) */
int index_load(struct index *index);

/** Where its file may lie: beside the trace, or (cached 1) in the cache folder. @return 0 where there is no such
 * place */
int index_place(const struct index *index, int cached, char out[PATH_MAX]);

void index_close(struct index **index);

struct index_facts {
	const char *path;       /* of the index; NULL: it is not kept */
	uint64_t frames, calls; /* whole frames; calls executed */
	int damaged;            /* 1: the trace is damaged behind its last whole frame */
	uint64_t checkpoints, blobs;
	uint64_t bytes;         /* of the index */
	double build_s;         /* seconds it took to make; 0: it was there */
};
struct index_facts index_facts(const struct index *index);

/** A command that replays do not execute, or only in part. */
struct index_lack {
	char name[64], why[128]; /* of the command; what is missing, "": all of it */
	uint64_t first, last;    /* frames that call it */
	uint64_t stays;          /* 1: frames behind the last one may lack it as well */
	uint64_t seen;           /* private */
};

/** What the trace's frames lack, in the order in which it is met. Found without building scenes: what only drawing
 * shows is not there. */
size_t index_lacks(const struct index *index, const struct index_lack **out);

/** The number of the call that ends a frame, and the unpacked bytes of the trace up to there. */
void index_frame(const struct index *index, uint64_t frame, uint64_t *call, uint64_t *offset);

/** When a frame ended (struct scene); 0: the recording does not tell. */
uint64_t index_frame_time(const struct index *index, uint64_t frame);

/** The last frame up to `frame` that has a checkpoint; 0 where none has: the trace's beginning. */
uint64_t index_checkpoint(const struct index *index, uint64_t frame);

/**
 * Begin at a checkpoint.
 * @param reader  of the same trace; goes on with the first call of that frame
 * @param x       as gls_exec_create made it; gets the state
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported). On failure destroy x, and seek the reader before it is read
 */
int index_restore(struct index *index, uint64_t checkpoint, struct trace_reader *reader, struct gls_exec *x);
