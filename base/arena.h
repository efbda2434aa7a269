/*
 * Memory that is given out piece by piece and taken back all at once; blocks are kept, so that a steady user of it
 * allocates nothing. All zero is a valid empty arena.
 */
#pragma once

#include <stddef.h>

struct arena_block;
struct arena {
	struct arena_block *first, *current;
	size_t used; /* in current */
};

/** n bytes, aligned to 16, not cleared; NULL: out of memory (not reported). Valid until arena_reset or arena_free. */
void *arena_alloc(struct arena *a, size_t n);

/** Take everything back. Blocks are kept up to `keep` bytes. */
void arena_reset(struct arena *a, size_t keep);
void arena_free(struct arena *a);
