#include "base/arena.h"

#include <stdlib.h>

#define FIRST_BYTES (1u << 10) /* size of the first block: most display lists are short */
#define BLOCK_BYTES (64u << 10) /* maximum size of later ones, each four times the one before */

struct arena_block {
	struct arena_block *next;
	size_t room;
	_Alignas(16) unsigned char bytes[];
};

void *arena_alloc(struct arena *a, size_t n)
{
	struct arena_block *block;
	void *out;

	if (n > (size_t)-1 - BLOCK_BYTES)
		return NULL;
	n = (n + 15) & ~(size_t)15;
	while (!a->current || n > a->current->room - a->used) {
		struct arena_block *next = a->current ? a->current->next : a->first;
		if (!next || next->room < n) {
			size_t room = a->current ? 4 * a->current->room : FIRST_BYTES;
			room = room < BLOCK_BYTES ? room : BLOCK_BYTES;
			room = room > n ? room : n;
			block = malloc(sizeof(*block) + room);
			if (!block)
				return NULL;
			block->room = room;
			block->next = next;
			if (a->current)
				a->current->next = block;
			else
				a->first = block;
			next = block;
		}
		a->current = next;
		a->used = 0;
	}
	out = a->current->bytes + a->used;
	a->used += n;
	return out;
}

void arena_reset(struct arena *a, size_t keep)
{
	struct arena_block **link = &a->first;

	while (*link) {
		struct arena_block *block = *link;
		if (block->room <= keep) {
			keep -= block->room;
			link = &block->next;
			continue;
		}
		*link = block->next;
		free(block);
	}
	a->current = NULL;
	a->used = 0;
}

void arena_free(struct arena *a)
{
	arena_reset(a, 0);
}
