#include "replay/gl/geometry/list_assemble.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/arena.h"
#include "base/err.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/gl/geometry/list.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* A sequence of Begin/End pairs with only vertex attributes in between. */
struct batch {
	uint32_t known; /* attributes set before the first vertex */
	uint32_t set;   /* attributes set anywhere in it */
	uint32_t end;   /* op after the last complete End; 0: there is none */
	uint32_t stop;  /* op that does not fit, or whose vertex needs an unknown value */
};

/* 1 if the op may be part of a batch. */
static int fits_batch(const struct gls_exec *assembler, const struct gls_op *op)
{
	const struct gls_command *k = &gls_commands[op->command];
	const struct gls_geometry *g = &assembler->pending.geometry;
	int open = assembler->st->begin_mode != 0;
	enum scene_primitive kind;

	if (op->form == GLS_OP_MESH || k->role == GLS_ROLE_EDGE_FLAG)
		return 0;
	if (k->role == GLS_ROLE_VERTEX_ATTRIB && !open &&
	    (op->form != GLS_OP_CALL || !op->n || gls_value_int(&op->args[0]) == 0))
		return 0; /* meshes cannot set it */
	if (k->kind == GLS_KIND_VERTEX)
		return 1;
	if (gls_op_is(op, GLS_ROLE_END))
		return open;
	if (!gls_op_is(op, GLS_ROLE_BEGIN) || open || op->form != GLS_OP_CALL)
		return 0;
	kind = gls_mode_kind((uint32_t)gls_value_int(&op->args[0]));
	return kind && (!g->n_vertices || (g->kind == kind && g->n_vertices <= GLS_MAX_PENDING_VERTICES));
}

/*
 * Run ops [first, last) through the assembler, as far as they form a batch. If `last` is the end of the batch, its
 * geometry is left in the assembler.
 */
static void collect_batch(struct gls_exec *assembler, const struct gls_list *list, uint32_t first, uint32_t last,
                          struct batch *batch)
{
	struct trace_value args[GLS_MAX_PACKED + 1];
	struct gls_geometry *g = &assembler->pending.geometry;
	struct call c = gls_list_call(assembler);

	gls_geometry_clear(g);
	assembler->st->begin_mode = 0;
	memset(&assembler->st->waiting, 0, sizeof(assembler->st->waiting));
	*batch = (struct batch){ .stop = first };
	for (uint32_t i = first; i < last && fits_batch(assembler, &list->ops[i]); i++) {
		const struct gls_op *op = &list->ops[i];
		uint32_t n = g->n_vertices, touched = g->touched, given = g->given;
		const int open = assembler->st->begin_mode != 0;
		gls_op_unpack(op, args, &c);
		assembler->dispatch(assembler, &c, op->command, NULL);
		g->given = open ? g->given : given; /* in a list, attributes outside Begin and End stay apart */
		if (n == 0 && g->n_vertices)
			batch->known = touched;
		batch->set |= touched | g->touched;
		batch->stop = i;
		if (n && g->n_vertices > n && touched & ~batch->known)
			return; /* an earlier vertex uses an unknown value, which may equal this one or not */
		batch->stop = i + 1;
		if (gls_op_is(op, GLS_ROLE_END))
			batch->end = i + 1;
	}
}

/* Copy the values of a mask's attributes, in ascending order, to the list's arena. */
static const float (*keep_values(struct gls_list *list, uint32_t mask, const float (*values)[4]))[4]
{
	float (*kept)[4] = arena_alloc(&list->arena, (size_t)(__builtin_popcount(mask) + 1) * sizeof(*kept));
	unsigned n = 0;

	for (; kept && mask; mask &= mask - 1)
		memcpy(kept[n++], values[__builtin_ctz(mask)], 16);
	return (const float (*)[4])kept;
}

static int keep_batch(struct gls_exec *x, struct gls_exec *assembler, struct gls_list *list, const struct batch *batch)
{
	struct gls_geometry *g = &assembler->pending.geometry;
	struct gls_op_mesh op = { .n_draws = g->n_draws, .given = g->given,
		                  .first_provokes = assembler->st->a.lighting.first_provokes };

	op.before = batch->known & ~g->varying;
	op.after = batch->set;
	op.before_values = keep_values(list, op.before, (const float (*)[4])g->constant);
	op.after_values = keep_values(list, op.after, (const float (*)[4])assembler->st->a.current.attribute);
	if (!op.before_values || !op.after_values) {
		gls_out_of_memory(x, 2 * N_GLS_ATTRIBUTES * sizeof(*op.before_values));
		return ERR_SYSTEM;
	}
	if (g->kind == SCENE_LINES)
		gls_geometry_part_strips(g);
	op.mesh = gls_geometry_mesh(x, g);
	return x->failed ? x->failed : gls_list_append_mesh(x, list, &op);
}

static int keep_op(struct gls_list *list, const struct gls_op *from, const struct gls_exec *x)
{
	struct trace_value args[GLS_MAX_PACKED + 1];
	struct call c = gls_list_call(x);
	struct gls_op *op;

	op = gls_list_add(list);
	if (!op)
		return ERR_SYSTEM;
	if (from->form != GLS_OP_MESH) {
		op->command = from->command;
		gls_op_unpack(from, args, &c);
		if (gls_list_keep(list, op, &c, from->unpack) == 0)
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

/* Copy ops that form no batch: up to where it stopped, and on to the End of an open Begin. */
static int keep_ops(struct gls_exec *x, struct gls_list *out, const struct gls_list *list, uint32_t stop, uint32_t *at)
{
	int open = 0;

	do {
		const struct gls_op *op = &list->ops[*at];
		open = gls_op_is(op, GLS_ROLE_BEGIN) || (open && !gls_op_is(op, GLS_ROLE_END));
		if (keep_op(out, op, x))
			return ERR_SYSTEM;
		(*at)++;
	} while (*at < list->n && (*at < stop || open));
	return 0;
}

/*
 * Some calls set again what the list itself has just set. Without them the batches on both sides become one mesh.
 * Programs that send every face separately are full of such calls. BindTexture, by target, and Material, by face and
 * name, are remembered. Any other call except vertices makes them forgotten.
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

/* 1 if both set something in common. Materials: face and name; textures: the target. */
static int overlap(const struct gls_op *a, const struct gls_op *b, int material)
{
	int64_t p, q;

	if (material != gls_op_is(a, GLS_ROLE_MATERIAL))
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
	int material = op->form == GLS_OP_CALL && gls_op_is(op, GLS_ROLE_MATERIAL);
	int texture = op->form == GLS_OP_CALL && gls_op_is(op, GLS_ROLE_BIND_TEXTURE);

	if (op->form != GLS_OP_MESH &&
	    (k->kind == GLS_KIND_VERTEX || gls_op_is(op, GLS_ROLE_BEGIN) || gls_op_is(op, GLS_ROLE_END)))
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
		list->ops[n] = list->ops[i]; /* moved first, because its place is remembered */
		n += !is_redundant(&known, &list->ops[n]);
	}
	list->n = n;
}

static int has_begin(const struct gls_list *list)
{
	for (uint32_t i = 0; i < list->n; i++)
		if (gls_op_is(&list->ops[i], GLS_ROLE_BEGIN))
			return 1;
	return 0;
}

/* ---- the assembler: a separate machine with one context that vertices are run through ---- */

struct assembler {
	struct gls_exec machine; /* must be first */
	struct gls_state state;
};

/* The assembler, ready for the list being compiled; NULL: out of memory. */
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
	a->machine.drawn_list = x->st->list_name;
	a->machine.counts = x->counts; /* borrowed: its calls are counted as the program's */
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

/* Copy a list with its batches assembled, into a new arena. The old one is freed. */
static struct gls_list *assemble(struct gls_exec *x, struct gls_list *list)
{
	struct gls_exec *assembler = find_assembler(x);
	struct gls_list *out = calloc(1, sizeof(*out));
	int failed = !out || !assembler;

	for (uint32_t i = 0; i < list->n && !failed;) {
		struct batch batch;
		collect_batch(assembler, list, i, list->n, &batch);
		if (!batch.end) {
			failed = keep_ops(x, out, list, batch.stop, &i) != 0;
			continue;
		}
		if (batch.stop > batch.end) /* run it again up to its end: what came after it has changed the geometry */
			collect_batch(assembler, list, i, batch.end, &batch);
		failed = keep_batch(x, assembler, out, &batch) != 0;
		i = batch.end;
	}
	if (assembler && assembler->failed)
		gls_fail(x);
	if (failed || x->failed) {
		gls_out_of_memory(x, sizeof(*out));
		if (out)
			gls_list_free(out);
		return list;
	}
	gls_list_free(list);
	return out;
}

struct gls_list *gls_list_assemble(struct gls_exec *x, struct gls_list *list)
{
	drop_redundant(list);
	return has_begin(list) ? assemble(x, list) : list;
}
