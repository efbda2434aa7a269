/* Makes the pieces of a file in several threads, and writes them in order. */
#pragma once

#include <stddef.h>
#include <stdio.h>

/* Most pieces made ahead of the next one to be written: bounds memory. */
enum { ORDERED_AHEAD = 16 };

/**
 * Make piece `i`. Called on any thread, for several pieces at once.
 * @param out    the piece's own stream; on failure its contents are dropped
 * @param spent  total cost of all pieces up to i - ORDERED_AHEAD. It does not depend on scheduling, so the file is the
 *         same in every run
 * @param cost   receives the cost of this piece
 * @return 0 or ERR_* (reported), which ends the run
 */
typedef int ordered_make(void *context, size_t i, size_t spent, FILE *out, size_t *cost);

/**
 * Make pieces 0 to n - 1 on all cores and write them to `out` in order. Errors of `out` are left to the caller.
 * @return 0, the first ERR_* of a piece, or ERR_SYSTEM (reported) if out of memory
 */
int ordered_write(size_t n, ordered_make *make, void *context, FILE *out);
