/*
 * Runs inside the traced program. Begin..End runs: one that was drawn before is written as a call of a display list.
 *
 * The calls from glBegin to glEnd are kept as plain records and written when the run is whole. A run that was
 * drawn before becomes a display list that only the trace has, and from then on a single glCallList. The recorder
 * guesses what comes next: the run that followed the last one in the frame before. So a call of a static scene costs
 * the comparison of its arguments with those in the guessed run; nothing is copied or hashed.
 *
 * A record is a word (command, bytes of arguments in the upper half) and the arguments as C has them, packed one after
 * the other and padded to four bytes; struct command's `shape` says what they are.
 */
#pragma once

#include <stdint.h>
#include <string.h>

enum { RUNS_MAX_ARGUMENTS = 64 }; /* bytes of one call's arguments; GL's longest has 36 */

extern __thread struct runs_thread {
	int open;              /* a run is being kept */
	const uint8_t *expect; /* the record that the next call should be; NULL: nothing is expected */
	uint8_t *at, *end;     /* position of an unexpected record; RUNS_MAX_ARGUMENTS fit after `end` */
} runs_self __attribute__((tls_model("initial-exec"), visibility("hidden")));

/** glBegin. @return 1 if the run is kept: glBegin must not be written now */
int runs_begin(unsigned mode);
/** glEnd. @return 1 if it ended a kept run, which is now written in full */
int runs_end(void);
/** Edge flags were set. This context makes no more lists: their vertices would need flags known only at the call. */
void runs_edge_flag_set(void);
/**
 * glColorMaterial. If only the back face follows the colour, no more lists are made: Mesa (22.3.6) lights back faces
 * differently by a vertex's colour than by a constant one. A colour set before glBegin belongs to a vertex while
 * vertices are pending, but is a constant when a list is called.
 */
void runs_color_material(unsigned face);
/** The program began or ended a list of its own, or deleted some. */
void runs_list_state(void);
void runs_lists_used(unsigned first, long count);

/** Leave the guessed run; what was as guessed is copied. 0: there was no room, as below. */
int runs_diverge(void);
/** Make more room. @return 0: there is none; the run so far has been written and is no longer kept */
int runs_grow(void);

/** 1 if this thread keeps a run. */
static inline int runs_open(void)
{
	return runs_self.open;
}

/** A call inside the run. `bytes` should be a constant. @return 0: the run is no longer kept, so write the call */
static inline __attribute__((always_inline)) int runs_put(unsigned command, const void *arguments, unsigned bytes)
{
	uint32_t word = command | bytes << 16, padded = (bytes + 3) & ~3u;

	if (__builtin_expect(runs_self.expect != NULL, 1)) {
		uint32_t expected;

		memcpy(&expected, runs_self.expect, sizeof(expected));
		if (__builtin_expect(expected == word && memcmp(runs_self.expect + 4, arguments, bytes) == 0, 1)) {
			runs_self.expect += 4 + padded;
			return 1;
		}
		if (!runs_diverge())
			return 0;
	}
	if (runs_self.at >= runs_self.end && !runs_grow())
		return 0;
	if (bytes & 3)
		memset(runs_self.at + padded, 0, 4);
	memcpy(runs_self.at, &word, sizeof(word));
	memcpy(runs_self.at + 4, arguments, bytes);
	runs_self.at += 4 + padded;
	return 1;
}
