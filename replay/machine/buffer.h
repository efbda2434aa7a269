/* Buffer objects (GL 2.1 sec. 2.9). */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "replay/machine/state.h"

struct gls_exec;

struct gls_buffer {
	uint8_t *data;
	size_t bytes;
	uint64_t version; /* changes with the contents; unique among all buffers */
	uint64_t mapped;  /* address the program saw, 0: not mapped */
	size_t map_offset, map_bytes;
	uint32_t missing; /* number + 1 of the frame that read pixels into it and was not rendered; 0: nothing is missing */
	size_t missing_from, missing_to; /* the bytes that miss pixels are among these */
};

/** Bytes from one place to another were to become pixels that nobody has. missing: as in struct gls_buffer */
void gls_buffer_lose(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to, uint32_t missing);

/** All bytes from one place to another are known: they were written. */
void gls_buffer_fill(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to);

/**
 * A call looks at a buffer (NULL: none). Where the buffer misses pixels the replay goes back, if frames are built and
 * somebody renders.
 * @return its `missing`
 */
uint32_t gls_buffer_lacks(struct gls_exec *x, const struct gls_buffer *b);

/** The same where state that frames to come use is made of it: the replay goes back in any frame, and else the call is
 * counted as not done. */
void gls_buffer_keep(struct gls_exec *x, const struct gls_buffer *b);

/** A draw looks at a buffer, for a list if one is being made: what of the two above that asks for. */
void gls_buffer_draws(struct gls_exec *x, const struct gls_state *st, const struct gls_buffer *b);

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
