/* Stores calls in display lists, with the pixels that they read. */
#include "replay/gl/geometry/list.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "capture/format/call.h"
#include "capture/format/sizes.h"
#include "gl_tokens.h"
#include "replay/build/mesh.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

enum { MAX_ARGS = 16 }; /* most arguments of a command that reads pixels */

static int all_floats(const struct trace_value *v, uint64_t n)
{
	for (uint64_t i = 0; i < n; i++)
		if (v[i].type != TRACE_FLOAT)
			return 0;
	return n <= GLS_MAX_PACKED;
}

static float *pack_floats(struct arena *a, const struct trace_value *v, uint32_t n)
{
	float *floats = arena_alloc(a, (n + !n) * sizeof(*floats));

	for (uint32_t i = 0; floats && i < n; i++)
		floats[i] = v[i].f;
	return floats;
}

static int copy_value(struct arena *a, struct trace_value *to, const struct trace_value *from)
{
	struct trace_value *items;
	uint8_t *bytes;

	*to = *from;
	switch (from->type) {
	case TRACE_STRING:
	case TRACE_BLOB:
		bytes = arena_alloc(a, from->count + 1);
		if (!bytes)
			return ERR_SYSTEM;
		memcpy(bytes, from->blob, from->count);
		bytes[from->count] = 0;
		to->blob = bytes;
		return 0;
	case TRACE_ARRAY: case TRACE_STRUCT: case TRACE_REPR:
		items = arena_alloc(a, (from->count + !from->count) * sizeof(*items));
		if (!items)
			return ERR_SYSTEM;
		for (uint64_t i = 0; i < from->count; i++)
			if (copy_value(a, &items[i], &from->items[i]))
				return ERR_SYSTEM;
		to->items = items;
		return 0;
	case TRACE_WSTRING: /* no GL command takes one */
		to->type = TRACE_NONE;
		return 0;
	default:
		return 0;
	}
}

struct gls_op *gls_list_add(struct gls_list *list)
{
	if (list->n == list->room) {
		uint32_t room = list->room ? 2 * list->room : 64;
		struct gls_op *grown = realloc(list->ops, room * sizeof(*grown));
		if (!grown)
			return NULL;
		list->ops = grown;
		list->room = room;
	}
	memset(&list->ops[list->n], 0, sizeof(list->ops[0]));
	return &list->ops[list->n++];
}

int gls_list_keep(struct gls_list *list, struct gls_op *op, const struct call *c, const struct gls_pixel_store *unpack)
{
	struct gls_pixel_store *kept;
	struct trace_value *args;

	op->form = GLS_OP_CALL;
	op->n = c->n_args;
	op->args = args = arena_alloc(&list->arena, (c->n_args + !c->n_args) * sizeof(*args));
	if (!args)
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < c->n_args; i++) {
		if (copy_value(&list->arena, &args[i], &c->args[i]))
			return ERR_SYSTEM;
		if ((c->args[i].type != TRACE_BLOB && (int)i != gls_commands[op->command].pixels.at) || !unpack)
			continue;
		op->unpack = kept = arena_alloc(&list->arena, sizeof(*kept));
		if (!kept)
			return ERR_SYSTEM;
		*kept = *unpack;
	}
	return 0;
}

/* unpack: state for reading pixels in client memory; list compilation uses the current one (sec. 5.4). */
static int keep_call(struct gls_list *list, const struct call *c, uint32_t command,
                     const struct gls_pixel_store *unpack)
{
	const int packs = gls_commands[command].kind == GLS_KIND_VERTEX;
	struct gls_op *op = gls_list_add(list);

	if (!op)
		return ERR_SYSTEM;
	op->command = (uint16_t)command;
	if (packs && all_floats(c->args, c->n_args)) {
		op->form = GLS_OP_FLOATS;
		op->n = c->n_args;
		op->floats = pack_floats(&list->arena, c->args, op->n);
		return op->floats ? 0 : ERR_SYSTEM;
	}
	if (packs && c->n_args == 1 && c->args[0].type == TRACE_ARRAY && all_floats(c->args[0].items, c->args[0].count)) {
		op->form = GLS_OP_FLOAT_ARRAY;
		op->n = (uint32_t)c->args[0].count;
		op->floats = pack_floats(&list->arena, c->args[0].items, op->n);
		return op->floats ? 0 : ERR_SYSTEM;
	}
	if (gls_list_keep(list, op, c, unpack) == 0)
		return 0;
	list->n--;
	return ERR_SYSTEM;
}

static int extent_of(const struct call *c, int8_t i)
{
	return i < 0 ? 1 : (int)arg_i(c, (unsigned)i);
}

/* Upper bound on the bytes of pixels that a command reads. */
static size_t pixel_bytes(const struct gls_pixel_args *a, const struct call *c, const struct gls_pixel_store *s)
{
	const struct pixel_box box = {
		a->dims, a->format < 0 ? GL_COLOR_INDEX : arg_u(c, (unsigned)a->format),
		a->type < 0 ? GL_BITMAP : arg_u(c, (unsigned)a->type),
		extent_of(c, a->width), extent_of(c, a->height), extent_of(c, a->depth),
	};

	if (a->dims)
		return gls_pixel_bytes(s, &box);
	return a->width < 0 ? SIZE_MAX : arg_u(c, (unsigned)a->width);
}

/*
 * Pixels are read when the list is compiled, including those in a buffer (sec. 5.4, ARB_pixel_buffer_object): replace
 * their offset by the data.
 * @param args  [MAX_ARGS]; receives the arguments
 * @return 1 if the call reads a buffer
 */
static int take_pixels(struct gls_exec *x, struct gls_state *st, const struct call *c, const struct gls_pixel_args *a,
                       struct trace_value *args)
{
	const unsigned at = (unsigned)a->at;
	const uint8_t *data;
	size_t n, wanted;

	if (a->at < 0 || at >= c->n_args || c->n_args > MAX_ARGS)
		return 0;
	if (c->args[at].type == TRACE_BLOB || !st->client.unpack.buffer)
		return 0;
	gls_pixel_missing(x, st, c, at);
	data = gls_pixel_source(st, c, at, &n);
	wanted = pixel_bytes(a, c, &st->client.unpack);
	memcpy(args, c->args, c->n_args * sizeof(*args));
	args[at] = (struct trace_value){ .type = TRACE_BLOB, .count = n < wanted ? n : wanted,
		                         .blob = data ? data : (const uint8_t *)"" };
	return 1;
}

int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t command)
{
	struct gls_pixel_store unpack = st->client.unpack;
	struct trace_value args[MAX_ARGS];
	struct call with = *c;

	if (take_pixels(x, st, c, &gls_commands[command].pixels, args)) {
		with.args = args;
		unpack.buffer = 0;
	}
	if (keep_call(st->list, &with, command, &unpack) == 0)
		return 0;
	gls_out_of_memory(x, sizeof(struct gls_op));
	return ERR_SYSTEM;
}

int gls_list_append_mesh(struct gls_exec *x, struct gls_list *list, const struct gls_op_mesh *mesh)
{
	struct gls_op *op = gls_list_add(list);
	struct gls_op_mesh *kept = arena_alloc(&list->arena, sizeof(*kept));

	if (!op || !kept) {
		gls_mesh_release(mesh->mesh);
		gls_out_of_memory(x, sizeof(*op) + sizeof(*kept));
		return ERR_SYSTEM;
	}
	*kept = *mesh;
	op->form = GLS_OP_MESH;
	op->command = (uint16_t)x->command;
	op->mesh = kept;
	return 0;
}

struct call gls_list_call(const struct gls_exec *x)
{
	struct call c = *x->call;

	c.ret.type = TRACE_NONE;
	return c;
}

void gls_op_unpack(const struct gls_op *op, struct trace_value *args, struct call *c)
{
	c->args = args;
	c->n_args = op->n;
	if (op->form == GLS_OP_CALL) {
		c->args = op->args;
		return;
	}
	for (uint32_t i = 0; i < op->n; i++)
		args[i] = (struct trace_value){ .type = TRACE_FLOAT, .f = op->floats[i] };
	if (op->form == GLS_OP_FLOAT_ARRAY) {
		args[GLS_MAX_PACKED] = (struct trace_value){ .type = TRACE_ARRAY, .count = op->n, .items = args };
		c->args = &args[GLS_MAX_PACKED];
		c->n_args = 1;
	}
}

void gls_list_free(struct gls_list *list)
{
	for (uint32_t i = 0; i < list->n; i++)
		if (list->ops[i].form == GLS_OP_MESH)
			gls_mesh_release(list->ops[i].mesh->mesh);
	free(list->ops);
	free(list->effect.ops);
	arena_free(&list->arena);
	free(list);
}
