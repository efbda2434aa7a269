/*
 * Runs inside the traced program. The recording of this process: its state, and the chunk of the trace that is being
 * filled. The writer's lock guards all of it but `state` and `n_frames`.
 */
#pragma once

#include <stdint.h>

struct stats_process;

enum recording_state { RECORDING_IDLE, RECORDING_ON, RECORDING_ENDED }; /* IDLE: nothing called yet, no file yet */
enum { RECORDING_MARGIN = 4096 }; /* bytes free at the write position: enough for any scalar arguments */

extern struct recording {
	_Atomic enum recording_state state;
	uint8_t *chunk, *end, *p; /* bytes not yet handed over lie in [chunk, p) */
	uint64_t n_calls;
	_Atomic uint64_t n_frames;
	struct stats_process *process; /* never NULL once recording */
	int quits; /* 1: the program ends with the recording, even if that fails */
} recording __attribute__((visibility("hidden")));

/** Create the trace and a row of figures for it. The state says whether it worked. */
void recording_open(const char *name);

/**
 * The chunk is complete up to p: hand it over. Ends the recording, with one message, if the file has failed. Keeps
 * errno.
 * @param now  1: return only when it is in the file
 * @return the position to continue at
 */
uint8_t *recording_spill(uint8_t *p, int now);

/** At least RECORDING_MARGIN bytes are free at the position that it returns. */
static inline uint8_t *put_room(uint8_t *p)
{
	return recording.end - p < RECORDING_MARGIN ? recording_spill(p, 0) : p;
}
