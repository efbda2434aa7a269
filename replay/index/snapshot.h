/*
 * The GL state machine between two frames, as bytes: an index stores them so that a replay can start in the middle.
 *
 * Structs of the state are saved as they are in memory, without their pointers, so that a new plain member is saved
 * without further code. Data behind a pointer is saved by hand. layout.txt lists how each pointer is treated, and code
 * with a pointer that is not listed does not compile. `relume index --check` compares restored states with replayed
 * ones, byte by byte. Large data (texels, buffers, lists, meshes) is stored in blobs: each content is stored once.
 *
 * Why not a stream of calls that rebuilds the state? Every seek would have to execute it. It cannot express all of the
 * state (errors, versions of buffers, meshes of lists), and nobody notices what it omits.
 *
 * Only a build with the same layout can read a snapshot: see snapshot_layout.h.
 */
#pragma once

#include "base/bytes.h"
#include "replay/machine/machine.h"

/* Storage for blobs. */
struct snapshot_blobs {
	/** Store bytes under their name (XXH3-128). @return 0 or ERR_* (reported) */
	int (*put)(void *user, const uint64_t name[2], const void *data, size_t n);
	/**
	 * NULL, or: 1 if the blob with that name is stored already, with the blobs put just before it, which it names.
	 */
	int (*have)(void *user, const uint64_t name[2]);
	/** The n bytes under a name; free with free(). NULL: missing, or not matching the name (reported) */
	uint8_t *(*get)(void *user, const uint64_t name[2], size_t n);
	void *user;
	uint64_t *count; /* not NULL: blobs are neither named nor stored, their sizes are added to this */
};

/** Blobs are named but not stored, for a state that is only compared. */
extern const struct snapshot_blobs snapshot_no_blobs;

/**
 * Save the state between two frames.
 * @return 0; 1 if the state cannot be saved just now (a Begin without End, a list being compiled); ERR_SYSTEM
 *         (reported)
 */
int snapshot_save(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out);

/**
 * As snapshot_save, with the pixels of drawables and renderbuffers, after gls_frame_settle. Without them everything
 * drawn counts as skipped.
 */
int snapshot_save_pixels(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out);

/**
 * Describe the part of the state that a byte of its snapshot belongs to ("state of context 0, byte 812"). A static
 * string.
 */
const char *snapshot_place(struct gls_exec *x, size_t at);

/**
 * Restore a saved state.
 * @param x  as gls_exec_create made it
 * @return 0, ERR_INPUT (reported: not a snapshot, or a blob is missing or damaged) or ERR_SYSTEM (reported); on failure
 *         destroy x
 */
int snapshot_load(struct gls_exec *x, const struct snapshot_blobs *blobs, const uint8_t *data, size_t n);
