/* Runs inside the traced program. Indices of draws: the vertices that they use, and how they are written. */
#pragma once

#include <stdint.h>

enum { INDICES_MAX_BYTES = 1 << 30 }; /* a larger size comes from a garbage count */

/** Vertices from `first` to `last`; last < 0: none. */
struct indices_range {
	long first, last;
};

/** The index that starts a new primitive and is no vertex; -1 for none. */
long indices_restart(unsigned type);

/** Widen the range by `count` indices in client memory or, at that offset, in the element array buffer. */
void indices_widen(struct indices_range *range, const void *indices, int count, unsigned type, long restart, long base);

/**
 * Before a draw: indices in client memory have a buffer in the trace, bound for the time of the draw.
 * @param range  NULL, or set to the vertices that they use
 */
void indices_bind(const void *indices, int count, unsigned type, struct indices_range *range);
/** The draw has been made. */
void indices_drawn(void);

uint8_t *put_indices(uint8_t *p, const void *indices, int count, unsigned type);
uint8_t *put_multi_indices(uint8_t *p, const void *const *indices, const int *counts, unsigned type, int draws);
