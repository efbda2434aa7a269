/* Unknown contents of buffer objects: pixels that were read into them in frames that were not rendered. */
#include "replay/machine/buffer.h"

#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

void gls_buffer_lose(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to, uint32_t missing)
{
	if (from >= to)
		return;
	b->missing_from = b->missing && b->missing_from < from ? b->missing_from : from;
	b->missing_to = b->missing && b->missing_to > to ? b->missing_to : to;
	b->missing = missing;
	b->version = ++x->caches.versions;
}

void gls_buffer_fill(struct gls_exec *x, struct gls_buffer *b, size_t from, size_t to)
{
	b->version = ++x->caches.versions;
	if (from <= b->missing_from && to >= b->missing_to)
		b->missing = 0;
}

uint32_t gls_buffer_lacks(struct gls_exec *x, const struct gls_buffer *b)
{
	if (!b || !b->missing)
		return 0;
	if (x->want && x->feedback.supply)
		gls_rewind(x, "a buffer object has what they drew");
	x->feedback.shows_earlier |= x->want && b->missing <= x->frame;
	return b->missing;
}

void gls_buffer_keep(struct gls_exec *x, const struct gls_buffer *b)
{
	if (!b || !b->missing)
		return;
	if (x->feedback.supply)
		gls_rewind(x, "a buffer object has what they drew");
	else
		gls_unsupported(x, "state made of pixels read into a buffer object");
}

void gls_buffer_draws(struct gls_exec *x, const struct gls_state *st, const struct gls_buffer *b)
{
	if (st->list)
		gls_buffer_keep(x, b);
	else
		gls_buffer_lacks(x, b);
}
