/*
 * A byte buffer to append to, and a reader that checks every length: for indexes and other files derived from a trace.
 * Numbers are in this machine's byte order; a file's version must say so.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A growing buffer. All zero is a valid empty one. */
struct bytes {
	uint8_t *data; /* free with free() */
	size_t n, room;
	int failed;    /* memory ran out; sticks */
};

void bytes_put(struct bytes *b, const void *data, size_t n);
static inline void bytes_put_u64(struct bytes *b, uint64_t value)
{
	if (b->room - b->n >= sizeof(value)) {
		memcpy(b->data + b->n, &value, sizeof(value));
		b->n += sizeof(value);
	} else {
		bytes_put(b, &value, sizeof(value));
	}
}
void bytes_put_text(struct bytes *b, const char *text); /* with its length and NUL */

/* Bytes being read. */
struct cursor {
	const uint8_t *p, *end;
	int failed; /* a read went past the end; sticks, and all later reads give 0 */
};

/** The next n bytes, or NULL. Borrowed. */
const void *cursor_get(struct cursor *c, uint64_t n);
uint64_t cursor_u64(struct cursor *c);
/** Copy the next n bytes, or zeros if fewer are left. With n = 0, out may be NULL. */
void cursor_copy(struct cursor *c, void *out, size_t n);
