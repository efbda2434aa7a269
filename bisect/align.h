/* Where two sequences agree: an edit script that is short (Myers 1986), or split at what occurs once in each where none is. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* a[a0 .. a1-1] stands where b[b0 .. b1-1] does. Between hunks both agree, element by element. */
struct align_hunk {
	size_t a0, a1, b0, b1;
};

/**
 * Align two sequences of keys.
 * @param hunks, n_hunks  receive what differs, in order; free with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int align_keys(const uint64_t *a, size_t n, const uint64_t *b, size_t m, struct align_hunk **hunks, size_t *n_hunks);
