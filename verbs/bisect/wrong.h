/*
 * A fault found by a frame's gates: a draw whose colours differ from the reference.
 *
 * Another recording has the same fault if the same call shows the same wrong colours at the same pixels, whatever else
 * the frame lacks. Only the worst pixels are compared.
 */
#pragma once

#include <stdint.h>

/**
 * A reduce_note (verbs/recording/reduce.h): renders the frame in mode gl, and notes the fault of the draw that is
 * blamed first (diff/score/score.h).
 */
int wrong_note(const char *trace, const char *reference, uint64_t frame, const char *note);

/** A reduce_again: renders the frame of another recording, and compares the pixels of the note. */
int wrong_again(const char *note, const char *trace, uint64_t frame, uint64_t call);
