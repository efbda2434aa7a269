/*
 * An arena: pieces of memory are handed out one by one and released all at once. Its blocks are kept, so once usage
 * is steady nothing more is allocated. All zero is a valid empty arena.
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

/** Release every piece. Keeps blocks of up to `keep` bytes in all. */
void arena_reset(struct arena *a, size_t keep);
void arena_free(struct arena *a);
