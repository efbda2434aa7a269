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
	uint64_t mapped;  /* address returned to the program; 0: not mapped */
	size_t map_offset, map_bytes;
	uint32_t missing; /* 1 + number of the skipped frame whose pixels were read into it; 0: all contents are known */
	size_t missing_from, missing_to; /* range of bytes that contains all unknown ones */
};

/** Mark bytes [from, to) as unknown: they hold pixels that were not rendered. missing: as in struct gls_buffer */
void gls_buffer_lose(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to, uint32_t missing);

/** Mark bytes [from, to) as known: they have been written. */
void gls_buffer_fill(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to);

/**
 * A call reads a buffer (NULL: none). If the buffer lacks pixels, frames are being built and there is a renderer, the
 * replay goes back.
 * @return its `missing`
 */
uint32_t gls_buffer_lacks(struct gls_exec *x, const struct gls_buffer *b);

/**
 * As gls_buffer_lacks, for data that becomes state used by later frames. The replay goes back in any frame; if it
 * cannot, the call is counted as unsupported.
 */
void gls_buffer_keep(struct gls_exec *x, const struct gls_buffer *b);

/** A draw reads a buffer: gls_buffer_keep if a list is being compiled, otherwise gls_buffer_lacks. */
void gls_buffer_draws(struct gls_exec *x, const struct gls_state *st, const struct gls_buffer *b);

/** @return NULL: no buffer has this name */
static inline struct gls_buffer *gls_buffer_find(struct gls_state *st, uint32_t name)
{
	return name ? table_find(&st->share->buffers, name) : NULL;
}

static inline void gls_buffer_free(struct gls_buffer *b)
{
	free(b->data);
	free(b);
}
