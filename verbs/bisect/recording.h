/* A recording as a list of hashes of its calls, for aligning it with another one. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* A call that is compared. */
struct recording_call {
	uint64_t key;  /* names_hash */
	uint64_t name; /* hash of the command */
	uint64_t at;   /* its place among all calls of the file, from 0 */
};

struct recording {
	const char *path;
	struct recording_call *calls; /* [n] */
	size_t n, room;
	size_t *frames;               /* [n_frames + 1]: index of each frame's first call */
	size_t n_frames, n_ended;     /* n_ended: without a last frame that the recording does not complete */
	size_t frames_room;
	uint64_t n_all;               /* number of calls, including those that are not compared */
};

/**
 * Read a recording.
 * @param ignore  commands that are not compared: shell patterns separated by commas; NULL: none
 * @param all     0: queries, waits and the recorder's notes of the time are not compared either; 1: they are
 * @param path    kept
 * @return 0 or ERR_* (reported)
 */
int recording_read(struct recording *r, const char *path, const char *ignore, int all);
void recording_free(struct recording *r);

/** The frame of a call. */
size_t recording_frame(const struct recording *r, size_t call);
