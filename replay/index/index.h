/*
 * The index of a trace: where its frames are, and checkpoints of the GL state machine to begin at, so that rendering frame
 * 90 000 costs no more than rendering frame 9.
 *
 * It lies beside the trace as TRACE.index, or, where that folder cannot be written, as HASH.index in $XDG_CACHE_HOME/relume
 * (~/.cache/relume). It is made on first need, and made anew where it is damaged, of another build's state machine, or of
 * a trace that has changed: it names the trace by size, time, the hash of its first MiB and, looked at where the time
 * differs, the hash of all of it.
 *
 * The file: a header; blobs, each once, under the XXH3-128 of their content, Snappy-packed where that saves something; a
 * table of contents with a checksum, packed alike. Checkpoints are snapshots (snapshot.h), themselves blobs. They come every MiB of
 * calls, not before one is restored in less time than the calls take, and less often where the state is large or changes so much
 * that the index would outgrow the trace.
 */
#ifndef REPLAY_INDEX_INDEX_H
#define REPLAY_INDEX_INDEX_H

#include "replay/machine/machine.h"
#include "replay/trace/reader.h"

struct replay;
struct index;

enum index_mode {
	INDEX_KEEP, /* use the one that is there, else make one */
	INDEX_FORCE /* make one */
};

/**
 * The index of a trace.
 * @param path  of the trace
 * @param hash  replay_trace_hash
 * @param fresh a replay of the trace that has executed nothing, which is run through where an index is made; NULL: one is opened
 * @return 0; ERR_INPUT or ERR_SYSTEM (reported). Where an index can be made but not written anywhere, that is a warning:
 *         this process has it, the next one makes it again
 */
int index_open(struct index **out, const char *path, const char *hash, enum index_mode mode, struct replay *fresh);
void index_close(struct index **index);

struct index_facts {
	const char *path;       /* of the index; NULL: it is not kept */
	uint64_t frames, calls; /* whole frames; calls executed */
	int damaged;            /* 1: the trace is damaged behind its last whole frame */
	uint64_t checkpoints, blobs;
	uint64_t bytes;         /* of the index */
	double build_s;         /* that it took to make it; 0: it was there */
};
struct index_facts index_facts(const struct index *index);

/** The number of the call that ends a frame, and the unpacked bytes of the trace up to there. */
void index_frame(const struct index *index, uint64_t frame, uint64_t *call, uint64_t *offset);

/** The last frame up to `frame` that a checkpoint begins with; 0 where there is none: the trace's begin. */
uint64_t index_checkpoint(const struct index *index, uint64_t frame);

/**
 * Begin at a checkpoint.
 * @param reader  of the same trace; goes on with the first call of that frame
 * @param x       as gls_exec_create made it; gets the state
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported); then both are of no use until the reader is sought again
 */
int index_restore(struct index *index, uint64_t checkpoint, struct trace_reader *reader, struct gls_exec *x);

/**
 * Replay the whole trace, and from every checkpoint to the next; compare each state reached with the one that is kept, byte
 * by byte.
 * @return 0; ERR_FAILED (reported: which checkpoint, which way, the first byte); ERR_INPUT, ERR_SYSTEM (reported)
 */
int index_check(struct index *index);

/* What the index needs to see of a replay (replay.c). */
struct trace_reader *replay_reader(struct replay *rp);
struct gls_exec *replay_exec(struct replay *rp);

#endif
