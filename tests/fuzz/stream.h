/*
 * Splits a trace's logical stream (capture/format/trace.md) into calls and reassembles it with changes, so that
 * libFuzzer's mutants of real recordings pass the reader. Signatures are defined again at their first use, so that
 * calls can be moved anywhere.
 *
 * Each call is written with its return right after its beginning; events originally in between follow it.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Omit, double or move calls, give them another call's name or other values, or insert calls of another stream.
 * @param b      the other stream, or NULL
 * @param out    receives at most `room` bytes; must not overlap a and b
 * @param state  of calls_draw (calls.h)
 * @return bytes written; 0: a cannot be parsed
 */
size_t stream_change(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t room,
                     unsigned *state);
