/* Buffer object commands (GL 2.1 sec. 2.9): bindings, data, copies and mappings. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* The buffer of this name, created if there is none. @return NULL: name 0, or out of memory (reported) */
static struct gls_buffer *find_or_make(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_buffer *b = gls_buffer_find(st, name);

	if (b || !name)
		return b;
	b = gls_object_create(x, &st->share->buffers, name, sizeof(*b));
	if (b)
		b->version = ++x->caches.versions;
	return b;
}

/* Offset of the name of the buffer bound to each target; other targets are unsupported. */
static const struct { uint32_t target, offset; } bindings[] = {
	{ GL_ARRAY_BUFFER, offsetof(struct gls_client_attribs, array_buffer) },
	{ GL_ELEMENT_ARRAY_BUFFER, offsetof(struct gls_client_attribs, element_buffer) },
	{ GL_COPY_READ_BUFFER, offsetof(struct gls_client_attribs, copy_read_buffer) },
	{ GL_COPY_WRITE_BUFFER, offsetof(struct gls_client_attribs, copy_write_buffer) },
	{ GL_DRAW_INDIRECT_BUFFER, offsetof(struct gls_client_attribs, indirect_buffer) },
	{ GL_PIXEL_UNPACK_BUFFER, offsetof(struct gls_client_attribs, unpack.buffer) },
	{ GL_PIXEL_PACK_BUFFER, offsetof(struct gls_client_attribs, pack.buffer) },
};
#define N_BINDINGS (sizeof(bindings) / sizeof(bindings[0]))

static uint32_t *binding_at(struct gls_state *st, size_t i)
{
	return (uint32_t *)((char *)&st->client + bindings[i].offset);
}

/* The name of the buffer bound to a target; NULL: an unsupported target. */
static uint32_t *find_binding(struct gls_state *st, uint32_t target)
{
	for (size_t i = 0; i < N_BINDINGS; i++)
		if (bindings[i].target == target)
			return binding_at(st, i);
	return NULL;
}

/* The buffer bound to a target. @return NULL: none (GL error), or an unsupported target (counted) */
static struct gls_buffer *bound_buffer(struct gls_exec *x, struct gls_state *st, uint32_t target)
{
	uint32_t *name = find_binding(st, target);
	struct gls_buffer *b;

	if (!name) {
		gls_unsupported(x, "buffer targets of later GL");
		return NULL;
	}
	b = gls_buffer_find(st, *name);
	if (!b)
		gls_error(x, st, GL_INVALID_OPERATION);
	return b;
}

GLS_HANDLER(glBindBuffer, CLIENT)
{
	uint32_t *name = find_binding(st, arg_u(c, 0));

	if (!name) {
		gls_unsupported(x, "buffer targets of later GL");
		return;
	}
	*name = arg_u(c, 1);
	find_or_make(x, st, *name);
}

/* Unmap a buffer if it is mapped, which also removes it from x->maps. NULL is allowed. */
static void unmap_buffer(struct gls_exec *x, struct gls_buffer *b)
{
	if (b && b->mapped)
		table_remove(&x->maps, b->mapped);
	if (b)
		b->mapped = 0;
}

GLS_HANDLER(glDeleteBuffers, CLIENT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		struct gls_buffer *b = table_remove(&st->share->buffers, name);
		if (!b)
			continue;
		unmap_buffer(x, b);
		gls_buffer_free(b);
		for (size_t k = 0; k < N_BINDINGS; k++)
			if (*binding_at(st, k) == name)
				*binding_at(st, k) = 0;
		for (unsigned a = 0; a < N_GLS_ARRAYS; a++)
			if (st->client.arrays[a].buffer == name)
				st->client.arrays[a].buffer = 0;
	}
}

/* Arguments: target, size, data. Bytes that are not in the recording are 0. */
static void set_data(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_buffer *b = bound_buffer(x, st, arg_u(c, 0));
	int64_t size = arg_i(c, 1);
	size_t n;
	const uint8_t *bytes = arg_blob(c, 2, &n);
	uint8_t *data;

	if (!b)
		return;
	if (gls_refuses(x, st, size < 0, GL_INVALID_VALUE))
		return;
	if (size > INT32_MAX) {
		gls_unsupported(x, "buffers of 2 GiB and more");
		return;
	}
	data = calloc(1, size ? (size_t)size : 1);
	if (!data) {
		gls_out_of_memory(x, (size_t)size);
		return;
	}
	if (bytes)
		memcpy(data, bytes, n < (size_t)size ? n : (size_t)size);
	free(b->data);
	b->data = data;
	b->bytes = (size_t)size;
	gls_buffer_fill(x, b, 0, SIZE_MAX);
}

/* GL_STREAM_DRAW to GL_DYNAMIC_COPY; every fourth value is unused. */
static int is_usage(uint32_t usage)
{
	return usage >= GL_STREAM_DRAW && usage <= GL_DYNAMIC_COPY && (usage - GL_STREAM_DRAW) % 4 < 3;
}

GLS_HANDLER(glBufferData, CLIENT)
{
	if (!gls_refuses(x, st, !is_usage(arg_u(c, 3)), GL_INVALID_ENUM))
		set_data(x, st, c);
}
GLS_HANDLER(glBufferStorage, CLIENT) { set_data(x, st, c); }

/* Write n bytes at an offset. Those beyond the buffer's end are dropped. */
static void write_buffer(struct gls_exec *x, struct gls_buffer *b, uint64_t offset, const uint8_t *bytes, size_t n)
{
	if (!bytes || offset >= b->bytes)
		return;
	n = n < b->bytes - offset ? n : b->bytes - offset;
	memcpy(b->data + offset, bytes, n);
	gls_buffer_fill(x, b, offset, offset + n);
}

GLS_HANDLER(glBufferSubData, CLIENT)
{
	struct gls_buffer *b = bound_buffer(x, st, arg_u(c, 0));
	size_t n;
	const uint8_t *bytes = arg_blob(c, 3, &n);

	if (b && (arg_i(c, 1) < 0 || arg_i(c, 2) < 0 || (uint64_t)arg_i(c, 1) + (uint64_t)arg_i(c, 2) > b->bytes))
		gls_error(x, st, GL_INVALID_VALUE);
	else if (b)
		write_buffer(x, b, (uint64_t)arg_i(c, 1), bytes, n < (size_t)arg_i(c, 2) ? n : (size_t)arg_i(c, 2));
}

/* ARB_copy_buffer. */
GLS_HANDLER(glCopyBufferSubData, CLIENT)
{
	struct gls_buffer *from = bound_buffer(x, st, arg_u(c, 0)), *to = bound_buffer(x, st, arg_u(c, 1));
	int64_t read = arg_i(c, 2), write = arg_i(c, 3), n = arg_i(c, 4);

	if (!from || !to)
		return;
	if (read < 0 || write < 0 || n < 0 || (uint64_t)read > from->bytes || (uint64_t)write > to->bytes ||
	    (uint64_t)n > from->bytes - (uint64_t)read || (uint64_t)n > to->bytes - (uint64_t)write ||
	    (from == to && read < write + n && write < read + n)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (n)
		write_buffer(x, to, (uint64_t)write, from->data + read, (size_t)n);
	/* The copy is unknown if the source range overlaps the source's unknown bytes. */
	if (n && from->missing && read < (int64_t)from->missing_to && read + n > (int64_t)from->missing_from)
		gls_buffer_lose(x, to, (size_t)write, (size_t)(write + n), from->missing);
}

/* Note the address that the program got for a mapped range: writes through it are recorded as memcpy. */
static void map_buffer(struct gls_exec *x, struct gls_buffer *b, const struct call *c, uint64_t offset, uint64_t n)
{
	uint64_t address = (uint64_t)gls_value_int(&c->ret);

	if (!b || !address || c->ret.type == TRACE_NONE)
		return;
	unmap_buffer(x, b);
	unmap_buffer(x, table_find(&x->maps, address));
	b->mapped = address;
	b->map_offset = offset;
	b->map_bytes = n;
	if (table_set(&x->maps, address, b))
		gls_fail(x);
}

GLS_HANDLER(glMapBuffer, CLIENT)
{
	struct gls_buffer *b = bound_buffer(x, st, arg_u(c, 0));

	if (b)
		map_buffer(x, b, c, 0, b->bytes);
}

GLS_HANDLER(glMapBufferRange, CLIENT)
{
	map_buffer(x, bound_buffer(x, st, arg_u(c, 0)), c, (uint64_t)arg_i(c, 1), (uint64_t)arg_i(c, 2));
}

GLS_HANDLER(glUnmapBuffer, CLIENT) { unmap_buffer(x, bound_buffer(x, st, arg_u(c, 0))); }

/*
 * Not a GL command: apitrace's record of bytes that the program stored through a pointer. They are written if the
 * address is in a mapped buffer.
 */
GLS_HANDLER(memcpy, WINDOW)
{
	uint64_t to = (uint64_t)arg_i(c, 0);
	size_t n;
	const uint8_t *bytes = arg_blob(c, 1, &n);

	for (size_t i = 0; i < x->maps.room; i++) {
		struct gls_buffer *b = x->maps.entries[i].value;
		if (b && to >= b->mapped && to - b->mapped < b->map_bytes) {
			uint64_t offset = to - b->mapped;
			write_buffer(x, b, b->map_offset + offset, bytes, n < b->map_bytes - offset ? n : b->map_bytes - offset);
			return;
		}
	}
}
