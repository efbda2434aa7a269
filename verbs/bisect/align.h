/* Aligns two sequences by a short edit script (Myers 1986), or splits them at elements that occur once in each. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* a[a0 .. a1-1] corresponds to b[b0 .. b1-1]. Between hunks both agree, element by element. */
struct align_hunk {
	size_t a0, a1, b0, b1;
};

/**
 * Align two sequences of keys.
 * @param hunks, n_hunks  receive the differences, in order; free with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int align_keys(const uint64_t *a, size_t n, const uint64_t *b, size_t m, struct align_hunk **hunks, size_t *n_hunks);
