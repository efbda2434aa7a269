/*
 * A trace's logical stream (capture/format/trace.md) taken apart into calls and put together otherwise: what libFuzzer
 * needs to come past the reader with real recordings. Signatures are defined anew where they are first used, so that
 * calls may go anywhere.
 *
 * A call is written whole, its return right behind its beginning; what stood between the two comes after it.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Calls left out, doubled, moved, given another's name, other values, or those of another stream among them.
 * @param b      the other stream, or NULL
 * @param out    receives at most `room` bytes; apart from a and b
 * @param state  of calls_draw (calls.h)
 * @return bytes written; 0: a cannot be taken apart
 */
size_t stream_change(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t room,
                     unsigned *state);
