/* A recording as a list of hashes of its calls, for aligning it with another one. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* A call that counts. */
struct recording_call {
	uint64_t key;  /* names_hash */
	uint64_t name; /* hash of the command */
	uint64_t at;   /* its place among all calls of the file, from 0 */
};

struct recording {
	const char *path;
	struct recording_call *calls; /* [n] */
	size_t n, room;
	size_t *frames;               /* [n_frames + 1]: the first call of each frame; the last of them may not end */
	size_t n_frames, n_ended, frames_room;
	uint64_t n_all;               /* calls, including those that do not count */
};

/**
 * Read a recording.
 * @param ignore  shell patterns of commands that do not count, with commas; NULL: none
 * @param all     0: queries and waits do not count either, nor the recorder's notes on time
 * @param path    kept
 * @return 0 or ERR_* (reported)
 */
int recording_read(struct recording *r, const char *path, const char *ignore, int all);
void recording_free(struct recording *r);

/** The frame of a call. */
size_t recording_frame(const struct recording *r, size_t call);
