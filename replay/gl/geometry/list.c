#include "replay/gl/geometry/list.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

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
		if (c->args[i].type != TRACE_BLOB || !unpack)
			continue;
		op->unpack = kept = arena_alloc(&list->arena, sizeof(*kept));
		if (!kept)
			return ERR_SYSTEM;
		*kept = *unpack;
	}
	return 0;
}

/* unpack: the state that pixels in client memory are read with, which is that of the moment (sec. 5.4). */
static int keep_call(struct gls_list *list, const struct call *c, uint32_t command, const struct gls_pixel_store *unpack)
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

int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t command)
{
	if (keep_call(st->list, c, command, &st->client.unpack) == 0)
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
