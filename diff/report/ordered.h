/* Several threads make the pieces of a file; they arrive in their order. */
#pragma once

#include <stddef.h>
#include <stdio.h>

/* Pieces made ahead of the next one to be written, at most: bounds memory. */
enum { ORDERED_AHEAD = 16 };

/**
 * Make piece `i`. Called on any thread, for several pieces at once.
 * @param out    a stream of its own for the piece; what was written is dropped on failure
 * @param spent  what all pieces up to i - ORDERED_AHEAD have cost together. This does not depend on scheduling: the
 *               file is the same in every run
 * @param cost   receives what this one costs
 * @return 0 or ERR_* (reported); the run ends then
 */
typedef int ordered_make(void *context, size_t i, size_t spent, FILE *out, size_t *cost);

/**
 * Make pieces 0 to n - 1 on all cores and write them to `out` in order; `out` keeps its own errors.
 * @return 0 or the first ERR_* of a piece, ERR_SYSTEM (reported) without memory
 */
int ordered_write(size_t n, ordered_make *make, void *context, FILE *out);
