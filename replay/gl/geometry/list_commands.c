/* Display list commands (GL 2.1 sec. 5.4): compiling, deleting, calling. */
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "capture/format/sizes.h"
#include "replay/gl/geometry/effect.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/list_assemble.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/gl/surface/draw.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* ---- compiling and deleting ---- */

GLS_HANDLER(glNewList, NOW)
{
	uint32_t name = arg_u(c, 0), mode = arg_u(c, 1);

	if (gls_refuses(x, st, name == 0, GL_INVALID_VALUE))
		return;
	if (gls_refuses(x, st, mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE, GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, st->list, GL_INVALID_OPERATION))
		return;
	if (!(c->flags & CALL_FAKE)) /* calls made up by the recorder were not lists in the program */
		gls_waiting_take(st, 0);
	st->list = calloc(1, sizeof(*st->list));
	if (!st->list) {
		gls_out_of_memory(x, sizeof(*st->list));
		return;
	}
	st->list_name = name;
	st->list_mode = mode;
}

static void remove_list(struct gls_state *st, uint32_t name)
{
	struct gls_list *list = table_remove(&st->share->lists, name);

	if (!list)
		return;
	st->share->epoch += list->inlined;
	gls_list_free(list);
}

GLS_HANDLER(glEndList, NOW)
{
	struct gls_list *list = st->list;

	if (gls_refuses(x, st, !list, GL_INVALID_OPERATION))
		return;
	if (!(c->flags & CALL_FAKE) && st->waiting.stored)
		gls_waiting_take(st, 1);
	st->list = NULL;
	list = gls_list_assemble(x, list);
	remove_list(st, st->list_name);
	if (table_set(&st->share->lists, st->list_name, list)) {
		gls_list_free(list);
		gls_fail(x);
	}
}

GLS_HANDLER(glDeleteLists, NOW)
{
	uint32_t first = arg_u(c, 0);
	int64_t range = arg_i(c, 1);
	const struct table *lists = &st->share->lists;

	if (gls_refuses(x, st, range < 0, GL_INVALID_VALUE))
		return;
	if ((uint64_t)range <= 2 * lists->room) {
		for (int64_t i = 0; i < range; i++)
			remove_list(st, first + (uint32_t)i);
		return;
	}
	for (size_t i = 0; i < lists->room;) {
		const struct table_entry *e = &lists->entries[i];
		if (e->value && e->key - first < (uint64_t)range)
			remove_list(st, (uint32_t)e->key); /* another entry may move here */
		else
			i++;
	}
}

GLS_HANDLER(glListBase, STATE) { st->a.list_base = arg_u(c, 0); }

/* Our recorder writes the calls that make its lists before it; other recorders' traces do not have them. */
GLS_HANDLER(glXUseXFont, WINDOW)
{
	const struct gls_list *list = x->st ? table_find(&x->st->share->lists, (uint32_t)arg_i(c, 3)) : NULL;

	if (!list || !list->n)
		gls_unsupported(x, "a font of the X server that is not in the trace");
}

/* ---- calling ---- */

static void set_attributes(struct gls_exec *x, struct gls_state *st, uint32_t mask, const float (*values)[4])
{
	for (; mask; mask &= mask - 1)
		gls_set_attribute(x, st, (unsigned)__builtin_ctz(mask), *values++);
}

static void run_mesh(struct gls_exec *x, struct gls_state *st, const struct gls_op_mesh *op)
{
	if (gls_refuses(x, st, st->begin_mode, GL_INVALID_OPERATION))
		return;
	gls_flush(x);
	gls_waiting_take(st, (int)st->waiting.stored);
	set_attributes(x, st, op->before, op->before_values);
	if (!st->a.current.edge_flag && op->mesh)
		gls_unsupported(x, "edge flags that are off when a list is called");
	if (op->mesh && op->first_provokes != st->a.lighting.first_provokes && st->a.lighting.shade_model == GL_FLAT)
		gls_unsupported(x, "lists compiled with another glProvokingVertex than they are called with");
	st->waiting.colored = op->before >> GLS_ATTR_COLOR & 1;
	if (op->mesh)
		gls_draw_mesh(x, st, op->mesh,
		              &(struct gls_mesh_draw){ (const float(*)[4])st->a.current.attribute, op->given, x->command,
		                                     x->call->number });
	st->waiting.colored = 0;
	set_attributes(x, st, op->after, op->after_values);
	gls_waiting_current(st);
}

static void call_list(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_list *list = table_find(&st->share->lists, name);
	struct trace_value args[GLS_MAX_PACKED + 1];
	const struct gls_effect *effect;
	const struct gls_op *ops;
	const uint32_t command = x->command;
	uint32_t n;
	struct call c;

	if (!list || x->list_depth == GLS_MAX_LIST_NESTING)
		return;
	effect = gls_effect_of(x, st, list);
	ops = effect ? effect->ops : list->ops;
	n = effect ? effect->n : list->n;
	if (n == 0 || (x->list_depth > 0 && gls_is_beyond_measure(x, n, "lists that call lists without end")))
		return;
	c = gls_list_call(x);
	if (x->list_depth++ == 0)
		x->drawn_list = name;
	for (const struct gls_op *op = ops; op < ops + n && !x->failed; op++) {
		if (op->form == GLS_OP_MESH) {
			run_mesh(x, st, op->mesh);
			continue;
		}
		if (op->form == GLS_OP_CALL) {
			c.args = op->args;
			c.n_args = op->n;
		} else {
			gls_op_unpack(op, args, &c);
		}
		x->dispatch(x, &c, op->command, op->unpack);
		x->command = command; /* draws are attributed to the command that called the list */
	}
	if (--x->list_depth == 0)
		x->drawn_list = 0;
}

/* Leave waiting attributes in the same state after a list whether its draws run or are omitted (effect.h). */
static void begin_lists(struct gls_state *st)
{
	if (st->begin_mode)
		return;
	gls_waiting_take(st, 0);
	gls_waiting_take(st, (int)st->waiting.stored);
}

static void end_lists(struct gls_state *st)
{
	if (!st->begin_mode)
		gls_waiting_current(st);
}

GLS_HANDLER(glCallList, INSIDE, CALL_LIST)
{
	begin_lists(st);
	call_list(x, st, arg_u(c, 0));
	end_lists(st);
}

/* Number of bytes of an element of CallLists (sec. 5.4); 0: not a valid type. */
static uint32_t element_value(uint32_t type, const uint8_t *p)
{
	uint16_t u16;
	uint32_t u32;
	float f;

	switch (type) {
	case GL_BYTE:
		return (uint32_t)(int32_t)(int8_t)p[0];
	case GL_UNSIGNED_BYTE:
		return p[0];
	case GL_SHORT:
		memcpy(&u16, p, 2);
		return (uint32_t)(int32_t)(int16_t)u16;
	case GL_UNSIGNED_SHORT:
		memcpy(&u16, p, 2);
		return u16;
	case GL_2_BYTES:
		return (uint32_t)p[0] << 8 | p[1];
	case GL_3_BYTES:
		return (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
	case GL_4_BYTES:
		return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
	case GL_FLOAT:
		memcpy(&f, p, 4);
		return f > -2147483648.0f && f < 2147483648.0f ? (uint32_t)(int32_t)f : 0;
	default:
		memcpy(&u32, p, 4);
		return u32;
	}
}

GLS_HANDLER(glCallLists, INSIDE)
{
	int64_t n = arg_i(c, 0);
	uint32_t type = arg_u(c, 1), base = st->a.list_base;
	size_t size = type <= GL_4_BYTES ? (size_t)type_bytes(type) : 0;
	size_t n_bytes;
	uint64_t n_items;
	const uint8_t *bytes = arg_blob(c, 2, &n_bytes);
	const struct trace_value *items = arg_items(c, 2, &n_items);

	if (!size || n < 0) {
		gls_error(x, st, size ? GL_INVALID_VALUE : GL_INVALID_ENUM);
		return;
	}
	begin_lists(st);
	for (int64_t i = 0; i < n && bytes && (uint64_t)(i + 1) * size <= n_bytes; i++)
		call_list(x, st, base + element_value(type, bytes + (size_t)i * size));
	for (int64_t i = 0; i < n && items && (uint64_t)i < n_items; i++)
		call_list(x, st, base + (uint32_t)gls_value_int(&items[i]));
	end_lists(st);
}
