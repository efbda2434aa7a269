/*
 * Display lists (GL 2.1 sec. 5.4).
 *
 * While a list is made its calls are kept, numbers of vertices packed. When it is whole, runs of Begin..End with nothing but vertex
 * attributes between are assembled into meshes once: such a list costs one instance per CallList. A run whose vertices need
 * an attribute that is only known when the list is called stays as calls.
 */
#include "replay/gl/geometry/list.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/arena.h"
#include "base/err.h"
#include "base/table.h"
#include "capture/format/trace.h"
#include "replay/build/mesh.h"
#include "replay/gl/geometry/effect.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/surface/draw.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/geometry.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

#define MAX_PACKED 16

/* ---- keeping calls ---- */

static int all_floats(const struct trace_value *v, uint64_t n)
{
	for (uint64_t i = 0; i < n; i++)
		if (v[i].type != TRACE_FLOAT)
			return 0;
	return n <= MAX_PACKED;
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
	case TRACE_ARRAY:
	case TRACE_STRUCT:
	case TRACE_REPR:
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

static struct gls_op *new_op(struct gls_list *list)
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

/* Keep a call with its arguments ready to be handed to a handler. Floats take eight times their bytes so. */
static int keep_ready(struct gls_list *list, struct gls_op *op, const struct call *c, const struct gls_pixel_store *unpack)
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
	struct gls_op *op = new_op(list);

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
	if (keep_ready(list, op, c, unpack) == 0)
		return 0;
	list->n--;
	return ERR_SYSTEM;
}

int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t command)
{
	if (keep_call(st->list, c, command, &st->client.unpack) == 0)
		return 0;
	gls_out_of_memory(x, c->n_args * sizeof(*c->args));
	return ERR_SYSTEM;
}

int gls_list_append_mesh(struct gls_exec *x, struct gls_list *list, const struct gls_op_mesh *mesh)
{
	struct gls_op *op = new_op(list);
	struct gls_op_mesh *kept = arena_alloc(&list->arena, sizeof(*kept));

	if (!op || !kept) {
		gls_mesh_release(mesh->mesh);
		gls_out_of_memory(x, sizeof(*kept));
		return ERR_SYSTEM;
	}
	*kept = *mesh;
	op->form = GLS_OP_MESH;
	op->command = (uint16_t)x->command;
	op->mesh = kept;
	return 0;
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

/* ---- running them ---- */

/* What calls out of a list have in common. */
static struct call call_of_list(const struct gls_exec *x)
{
	struct call c = *x->call;

	c.ret.type = TRACE_NONE;
	return c;
}

/* An op as the call it was. `args` is room for MAX_PACKED values and one more; c as call_of_list makes it. */
static void unpack_call(const struct gls_op *op, struct trace_value *args, struct call *c)
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
		args[MAX_PACKED] = (struct trace_value){ .type = TRACE_ARRAY, .count = op->n, .items = args };
		c->args = &args[MAX_PACKED];
		c->n_args = 1;
	}
}

static void set_attributes(struct gls_exec *x, struct gls_state *st, uint32_t mask, const float (*values)[4])
{
	for (; mask; mask &= mask - 1)
		gls_set_attribute(x, st, (unsigned)__builtin_ctz(mask), *values++);
}

static void run_mesh(struct gls_exec *x, struct gls_state *st, const struct gls_op_mesh *op)
{
	if (st->begin_mode) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	gls_flush(x);
	set_attributes(x, st, op->before, op->before_values);
	if (!st->a.current.edge_flag && op->mesh)
		gls_unsupported(x, "edge flags that are off when a list is called");
	if (op->mesh && op->first_provokes != st->a.lighting.first_provokes && st->a.lighting.shade_model == GL_FLAT)
		gls_unsupported(x, "lists made under another glProvokingVertex than they are called under");
	if (op->mesh)
		gls_draw_mesh(x, st, op->mesh, (const float (*)[4])st->a.current.attribute, x->command, x->call->number);
	set_attributes(x, st, op->after, op->after_values);
}

void gls_call_list(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_list *list = table_find(&st->share->lists, name);
	struct trace_value args[MAX_PACKED + 1];
	const struct gls_effect *effect;
	const struct gls_op *ops;
	uint32_t n;
	struct call c;

	if (!list || x->list_depth == GLS_MAX_LIST_NESTING)
		return;
	effect = gls_effect_of(x, st, list);
	ops = effect ? effect->ops : list->ops;
	n = effect ? effect->n : list->n;
	if (n == 0 || (x->list_depth > 0 && gls_is_beyond_measure(x, n, "lists that call lists without end")))
		return;
	c = call_of_list(x);
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
			unpack_call(op, args, &c);
		}
		x->dispatch(x, &c, op->command, op->unpack);
	}
	if (--x->list_depth == 0)
		x->drawn_list = 0;
}

/* ---- assembling runs of Begin..End ---- */

struct run {
	uint32_t known; /* attributes set before the first vertex */
	uint32_t set;   /* attributes set anywhere in it */
	uint32_t end;   /* op after the last whole End; 0: there is none */
	uint32_t stop;  /* op that did not fit, or whose vertex needs a value that is not known yet */
};

static int is_a(const struct gls_op *op, enum gls_role role)
{
	return op->form != GLS_OP_MESH && gls_commands[op->command].role == role;
}

/* May the op be part of a run? */
static int fits_run(const struct gls_exec *assembler, const struct gls_op *op)
{
	const struct gls_command *k = &gls_commands[op->command];
	const struct gls_geometry *g = &assembler->pending.geometry;
	int open = assembler->st->begin_mode != 0;
	enum scene_primitive kind;

	if (op->form == GLS_OP_MESH || k->role == GLS_ROLE_EDGE_FLAG)
		return 0;
	if (k->kind == GLS_KIND_VERTEX)
		return 1;
	if (is_a(op, GLS_ROLE_END))
		return open;
	if (!is_a(op, GLS_ROLE_BEGIN) || open || op->form != GLS_OP_CALL)
		return 0;
	kind = gls_mode_kind((uint32_t)gls_value_int(&op->args[0]));
	return kind && (!g->n_vertices || (g->kind == kind && g->n_vertices <= GLS_MAX_PENDING_VERTICES));
}

/*
 * Run ops [first, last) through the assembler, as far as they make a run.
 * Its geometry is left with what was collected up to run->end where `last` is that end.
 */
static void collect_run(struct gls_exec *assembler, const struct gls_list *list, uint32_t first, uint32_t last, struct run *run)
{
	struct trace_value args[MAX_PACKED + 1];
	struct gls_geometry *g = &assembler->pending.geometry;
	struct call c = call_of_list(assembler);

	gls_geometry_clear(g);
	assembler->st->begin_mode = 0;
	*run = (struct run){ .stop = first };
	for (uint32_t i = first; i < last && fits_run(assembler, &list->ops[i]); i++) {
		const struct gls_op *op = &list->ops[i];
		uint32_t n = g->n_vertices, touched = g->touched;
		unpack_call(op, args, &c);
		assembler->dispatch(assembler, &c, op->command, NULL);
		if (n == 0 && g->n_vertices)
			run->known = touched;
		run->set |= touched | g->touched;
		run->stop = i;
		if (n && g->n_vertices > n && touched & ~run->known)
			return; /* an earlier vertex has a value that is not known yet: it may be this one's or another */
		run->stop = i + 1;
		if (is_a(op, GLS_ROLE_END))
			run->end = i + 1;
	}
}

/* Values of a mask's attributes, in ascending order, in the list's arena. */
static const float (*keep_values(struct gls_list *list, uint32_t mask, const float (*values)[4]))[4]
{
	float (*kept)[4] = arena_alloc(&list->arena, (size_t)(__builtin_popcount(mask) + 1) * sizeof(*kept));
	unsigned n = 0;

	for (; kept && mask; mask &= mask - 1)
		memcpy(kept[n++], values[__builtin_ctz(mask)], 16);
	return (const float (*)[4])kept;
}

static int keep_run(struct gls_exec *x, struct gls_exec *assembler, struct gls_list *list, const struct run *run)
{
	struct gls_geometry *g = &assembler->pending.geometry;
	struct gls_op_mesh op = { .n_draws = g->n_draws, .first_provokes = assembler->st->a.lighting.first_provokes };

	op.before = run->known & ~g->given;
	op.after = run->set;
	op.before_values = keep_values(list, op.before, (const float (*)[4])g->constant);
	op.after_values = keep_values(list, op.after, (const float (*)[4])assembler->st->a.current.attribute);
	if (!op.before_values || !op.after_values) {
		gls_out_of_memory(x, sizeof(g->constant));
		return ERR_SYSTEM;
	}
	op.mesh = gls_geometry_mesh(x, g);
	return x->failed ? x->failed : gls_list_append_mesh(x, list, &op);
}

static int keep_op(struct gls_list *list, const struct gls_op *from, const struct gls_exec *x)
{
	struct trace_value args[MAX_PACKED + 1];
	struct call c = call_of_list(x);
	struct gls_op *op;

	op = new_op(list);
	if (!op)
		return ERR_SYSTEM;
	if (from->form != GLS_OP_MESH) {
		op->command = from->command;
		unpack_call(from, args, &c);
		if (keep_ready(list, op, &c, from->unpack) == 0)
			return 0;
		list->n--;
		return ERR_SYSTEM;
	}
	*op = *from;
	op->mesh = arena_alloc(&list->arena, sizeof(*op->mesh));
	if (!op->mesh) {
		list->n--;
		return ERR_SYSTEM;
	}
	struct gls_op_mesh copy = *from->mesh;
	copy.before_values = NULL;
	copy.after_values = NULL;
	copy.before = copy.after = 0; /* array draws set no attributes */
	if (copy.mesh)
		atomic_fetch_add(&copy.mesh->refs, 1);
	memcpy((void *)(uintptr_t)op->mesh, &copy, sizeof(copy));
	return 0;
}

/* Keep ops that make no run as they are: up to where it stopped, and on to the End of a Begin that is open there. */
static int keep_ops(struct gls_exec *x, struct gls_list *out, const struct gls_list *list, uint32_t stop, uint32_t *at)
{
	int open = 0;

	do {
		const struct gls_op *op = &list->ops[*at];
		open = is_a(op, GLS_ROLE_BEGIN) || (open && !is_a(op, GLS_ROLE_END));
		if (keep_op(out, op, x))
			return ERR_SYSTEM;
		(*at)++;
	} while (*at < list->n && (*at < stop || open));
	return 0;
}

/*
 * Calls that set again what the list itself has just set: dropping them lets the runs on both sides become one mesh.
 * Programs that send every face by itself are full of them. Known are BindTexture and Material by target, or face and
 * name; anything else but vertices makes the list forget what it knows.
 */
#define N_REMEMBERED 16
struct remembered {
	const struct gls_op *ops[N_REMEMBERED];
	unsigned n;
};

static int equal_args(const struct gls_op *a, const struct gls_op *b)
{
	if (a->command != b->command || a->form != GLS_OP_CALL || b->form != GLS_OP_CALL || a->n != b->n)
		return 0;
	for (uint32_t i = 0; i < a->n; i++) {
		const struct trace_value *v = &a->args[i], *w = &b->args[i];
		if (v->type != w->type || v->count != w->count || (v->type != TRACE_ARRAY && v->u != w->u))
			return 0;
		for (uint64_t k = 0; v->type == TRACE_ARRAY && k < v->count; k++)
			if (v->items[k].type != w->items[k].type || v->items[k].u != w->items[k].u)
				return 0;
	}
	return 1;
}

/* Do both set something in common? Materials: face and name; textures: the target. */
static int overlap(const struct gls_op *a, const struct gls_op *b, int material)
{
	int64_t p, q;

	if (material != is_a(a, GLS_ROLE_MATERIAL))
		return 0;
	if (!material || a->n < 2 || b->n < 2)
		return 1;
	p = gls_value_int(&a->args[1]);
	q = gls_value_int(&b->args[1]);
	return p == q || (p == GL_AMBIENT_AND_DIFFUSE && (q == GL_AMBIENT || q == GL_DIFFUSE)) ||
	       (q == GL_AMBIENT_AND_DIFFUSE && (p == GL_AMBIENT || p == GL_DIFFUSE));
}

static int is_redundant(struct remembered *r, const struct gls_op *op)
{
	const struct gls_command *k = &gls_commands[op->command];
	int material = op->form == GLS_OP_CALL && is_a(op, GLS_ROLE_MATERIAL);
	int texture = op->form == GLS_OP_CALL && is_a(op, GLS_ROLE_BIND_TEXTURE);

	if (op->form != GLS_OP_MESH && (k->kind == GLS_KIND_VERTEX || is_a(op, GLS_ROLE_BEGIN) || is_a(op, GLS_ROLE_END)))
		return 0;
	if (!material && !texture) {
		r->n = 0;
		return 0;
	}
	for (unsigned i = 0; i < r->n; i++)
		if (equal_args(r->ops[i], op))
			return 1;
	for (unsigned i = 0; i < r->n;) {
		if (overlap(r->ops[i], op, material))
			r->ops[i] = r->ops[--r->n];
		else
			i++;
	}
	if (r->n < N_REMEMBERED)
		r->ops[r->n++] = op;
	return 0;
}

static void drop_redundant(struct gls_list *list)
{
	struct remembered known = { .n = 0 };
	uint32_t n = 0;

	for (uint32_t i = 0; i < list->n; i++) {
		list->ops[n] = list->ops[i]; /* moved before it is remembered where it stands */
		n += !is_redundant(&known, &list->ops[n]);
	}
	list->n = n;
}

static int has_begin(const struct gls_list *list)
{
	for (uint32_t i = 0; i < list->n; i++)
		if (is_a(&list->ops[i], GLS_ROLE_BEGIN))
			return 1;
	return 0;
}

/* ---- the assembler: a machine of its own, with one context, that vertices are run through ---- */

struct assembler {
	struct gls_exec machine; /* first */
	struct gls_state state;
};

/* Ready for a list that is made now; NULL: out of memory. */
static struct gls_exec *find_assembler(struct gls_exec *x)
{
	struct assembler *a = (struct assembler *)x->assembler;

	if (!a && (a = calloc(1, sizeof(*a))))
		x->assembler = &a->machine;
	if (!a)
		return NULL;
	a->machine.path = x->path;
	a->machine.want = 1;
	a->machine.call = x->call;
	a->machine.counts = x->counts; /* borrowed: what its calls meet counts as the program's */
	a->machine.dispatch = x->dispatch;
	a->machine.pending.mixes = 1;
	a->machine.st = &a->state;
	a->state.a.current.edge_flag = 1;
	a->state.a.lighting.first_provokes = x->st->a.lighting.first_provokes;
	return &a->machine;
}

void gls_assembler_free(struct gls_exec *assembler)
{
	if (assembler)
		gls_geometry_free(&assembler->pending.geometry);
	free(assembler);
}

/* The same list with its runs assembled, in an arena of its own. The old one is freed. */
static struct gls_list *assemble(struct gls_exec *x, struct gls_list *list)
{
	struct gls_exec *assembler = find_assembler(x);
	struct gls_list *out = calloc(1, sizeof(*out));
	int failed = !out || !assembler;

	for (uint32_t i = 0; i < list->n && !failed;) {
		struct run run;
		collect_run(assembler, list, i, list->n, &run);
		if (!run.end) {
			failed = keep_ops(x, out, list, run.stop, &i) != 0;
			continue;
		}
		if (run.stop > run.end) /* once more up to its end: what came after it left traces in the geometry */
			collect_run(assembler, list, i, run.end, &run);
		failed = keep_run(x, assembler, out, &run) != 0;
		i = run.end;
	}
	if (failed || assembler->failed) {
		gls_fail(x);
		if (out)
			gls_list_free(out);
		return list;
	}
	gls_list_free(list);
	return out;
}

/* ---- commands ---- */

GLS_HANDLER(glNewList, NOW)
{
	uint32_t name = arg_u(c, 0), mode = arg_u(c, 1);

	if (name == 0) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	if (st->list) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
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

	if (!list) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	st->list = NULL;
	drop_redundant(list);
	if (has_begin(list))
		list = assemble(x, list);
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

	if (range < 0) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if ((uint64_t)range <= 2 * lists->room) {
		for (int64_t i = 0; i < range; i++)
			remove_list(st, first + (uint32_t)i);
		return;
	}
	for (size_t i = 0; i < lists->room;) {
		const struct table_entry *e = &lists->entries[i];
		if (e->value && e->key - first < (uint64_t)range)
			remove_list(st, (uint32_t)e->key); /* another may move here */
		else
			i++;
	}
}

GLS_HANDLER(glListBase, STATE) { st->a.list_base = arg_u(c, 0); }

/* Its lists are made by the calls that our recorder writes before it; what other recorders write has none. */
GLS_HANDLER(glXUseXFont, WINDOW)
{
	const struct gls_list *list = x->st ? table_find(&x->st->share->lists, (uint32_t)arg_i(c, 3)) : NULL;

	if (!list || !list->n)
		gls_unsupported(x, "a font of the X server that the trace does not hold");
}

GLS_HANDLER(glCallList, INSIDE, CALL_LIST) { gls_call_list(x, st, arg_u(c, 0)); }

/* Bytes of an element of CallLists (table 5.?: sec. 5.4), 0: no type. */
static unsigned element_bytes(uint32_t type)
{
	switch (type) {
	case GL_BYTE:
	case GL_UNSIGNED_BYTE:
		return 1;
	case GL_SHORT:
	case GL_UNSIGNED_SHORT:
	case GL_2_BYTES:
		return 2;
	case GL_3_BYTES:
		return 3;
	case GL_INT:
	case GL_UNSIGNED_INT:
	case GL_FLOAT:
	case GL_4_BYTES:
		return 4;
	default:
		return 0;
	}
}

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
	unsigned size = element_bytes(type);
	size_t n_bytes;
	uint64_t n_items;
	const uint8_t *bytes = arg_blob(c, 2, &n_bytes);
	const struct trace_value *items = arg_items(c, 2, &n_items);

	if (!size || n < 0) {
		gls_error(x, st, size ? GL_INVALID_VALUE : GL_INVALID_ENUM);
		return;
	}
	for (int64_t i = 0; i < n && bytes && (uint64_t)(i + 1) * size <= n_bytes; i++)
		gls_call_list(x, st, base + element_value(type, bytes + i * size));
	for (int64_t i = 0; i < n && items && (uint64_t)i < n_items; i++)
		gls_call_list(x, st, base + (uint32_t)gls_value_int(&items[i]));
}
