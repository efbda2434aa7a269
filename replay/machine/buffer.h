/* Buffer objects (GL 2.1 sec. 2.9). */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "replay/machine/state.h"

struct gls_buffer {
	uint8_t *data;
	size_t bytes;
	uint64_t version; /* changes with the contents; unique among all buffers */
	uint64_t mapped;  /* address the program saw, 0: not mapped */
	size_t map_offset, map_bytes;
};

/** NULL: there is none of this name. */
static inline struct gls_buffer *gls_buffer_find(struct gls_state *st, uint32_t name)
{
	return name ? table_find(&st->share->buffers, name) : NULL;
}

static inline void gls_buffer_free(struct gls_buffer *b)
{
	free(b->data);
	free(b);
}
