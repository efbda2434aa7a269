#include "base/bytes.h"

#include <stdlib.h>
#include <string.h>

void bytes_put(struct bytes *b, const void *data, size_t n)
{
	if (n > b->room - b->n && !b->failed) {
		size_t room = 2 * (b->n + n) + 4096;
		uint8_t *grown = realloc(b->data, room);

		b->failed = !grown;
		if (grown) {
			b->data = grown;
			b->room = room;
		}
	}
	if (b->failed || n == 0)
		return;
	memcpy(b->data + b->n, data, n);
	b->n += n;
}

void bytes_put_text(struct bytes *b, const char *text)
{
	size_t n = strlen(text);

	bytes_put_u64(b, n);
	bytes_put(b, text, n + 1);
}

const void *cursor_get(struct cursor *c, uint64_t n)
{
	const uint8_t *at = c->p;

	if (c->failed || n > (uint64_t)(c->end - c->p)) {
		c->failed = 1;
		return NULL;
	}
	c->p += n;
	return at;
}

uint64_t cursor_u64(struct cursor *c)
{
	uint64_t value;

	cursor_copy(c, &value, sizeof(value));
	return value;
}

void cursor_copy(struct cursor *c, void *out, size_t n)
{
	const void *at = n ? cursor_get(c, n) : NULL;

	if (at)
		memcpy(out, at, n);
	else if (n)
		memset(out, 0, n);
}
