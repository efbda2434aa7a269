/*
 * A fault that a frame's gates find: a draw whose pixels show other colours than the reference has.
 *
 * It is the same fault in another recording where the same call shows the same wrong colours at the same pixels, of which the worst are
 * looked at, whatever else the frame lacks.
 */
#pragma once

#include <stdint.h>

/** A reduce_note (replay/verbs/reduce.h): renders the frame in mode gl, and takes the draw that is blamed first (diff/score/score.h). */
int wrong_note(const char *trace, const char *reference, uint64_t frame, const char *note);

/** A reduce_again. */
int wrong_again(const char *note, const char *trace, uint64_t frame, uint64_t call);
