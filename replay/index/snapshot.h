/*
 * The GL state machine between two frames, as bytes: an index keeps them so that a replay can begin in the middle.
 *
 * Structs of the state are saved as they lie in memory, without their pointers: a plain member that is added is saved
 * by itself. What a pointer leads to is saved by hand. layout.txt names what becomes of every pointer, and a new one
 * does not compile before it is named there. `relume index --check` compares states restored with states replayed, byte
 * by byte. Big things (texels, buffers, lists, meshes) are blobs: each content is kept once.
 *
 * Why not a stream of calls that rebuilds the state? Every seek would have to execute it. It cannot say all that the
 * state holds (errors, versions of buffers, meshes of lists), and nobody notices what it forgets.
 *
 * Only a build with the same layout can read a snapshot: see snapshot_layout.h.
 */
#pragma once

#include "base/bytes.h"
#include "replay/machine/machine.h"

/* Where blobs are kept. */
struct snapshot_blobs {
	/** Keep bytes under their name (XXH3-128). @return 0 or ERR_* (reported) */
	int (*put)(void *user, const uint64_t name[2], const void *data, size_t n);
	/** NULL, or: 1 where the blob of that name and those put just before it, which it names, are kept already. */
	int (*have)(void *user, const uint64_t name[2]);
	/** The n bytes of a name; free with free(). NULL: they are not there, or not what the name says (reported) */
	uint8_t *(*get)(void *user, const uint64_t name[2], size_t n);
	void *user;
	uint64_t *count; /* not NULL: blobs are neither named nor kept, their bytes are added to this */
};

/** Blobs are named and kept nowhere: a state that is only compared. */
extern const struct snapshot_blobs snapshot_no_blobs;

/**
 * Save the state as it is between two frames.
 * @return 0; 1 where there is something that cannot be saved just now (a Begin without End, a list that is being made);
 *         ERR_SYSTEM (reported)
 */
int snapshot_save(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out);

/** The same with the pixels of drawables and renderbuffers, after gls_frame_settle. Without them all that was drawn
 * counts as skipped. */
int snapshot_save_pixels(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out);

/** What the byte at a place of a snapshot of this state belongs to ("state of context 0, byte 812"). A static
 * string. */
const char *snapshot_place(struct gls_exec *x, size_t at);

/**
 * Bring a state machine to a saved state.
 * @param x  as gls_exec_create made it
 * @return 0, ERR_INPUT (reported: no snapshot, or a blob is missing or damaged) or ERR_SYSTEM (reported); then destroy
 * x
 */
int snapshot_load(struct gls_exec *x, const struct snapshot_blobs *blobs, const uint8_t *data, size_t n);
