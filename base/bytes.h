/*
 * Bytes written one after the other, and read again with nothing believed: for indexes and what else is kept of a trace.
 * Numbers are as this machine has them; whoever keeps such bytes says so in their version.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Bytes that grow. All zero: none. */
struct bytes {
	uint8_t *data; /* free with free() */
	size_t n, room;
	int failed;    /* out of memory at some time; sticks */
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
void bytes_put_text(struct bytes *b, const char *text); /* its length and NUL with it */

/* Bytes being read. */
struct cursor {
	const uint8_t *p, *end;
	int failed; /* something was asked for that is not there; sticks, and everything then is 0 */
};

/** The next n bytes, or NULL. Borrowed. */
const void *cursor_get(struct cursor *c, uint64_t n);
uint64_t cursor_u64(struct cursor *c);
/** Copy the next n bytes; all 0 where they are not there. With n = 0, out may be NULL. */
void cursor_copy(struct cursor *c, void *out, size_t n);
