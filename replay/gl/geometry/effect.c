/*
 * The effect of a display list if nothing is drawn.
 *
 * A skipped frame needs no more than the effect. Most lists of text and models change nothing: they have meshes,
 * matrices between PushMatrix and PopMatrix, and textures and attributes that the next letter sets again. The effect of
 * a list consists of the ops that remain, including those of the lists it calls. Running it produces the same bits as
 * the whole list, in any state. If this cannot be guaranteed, there is no effect and the list itself runs.
 *
 * An effect is valid as long as the lists and textures that it was derived from. The share group counts deletions
 * (epoch).
 */
#include "replay/gl/geometry/effect.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"

#define MAX_OPS (1u << 16) /* per list, including ops of inlined lists */
#define MAX_NESTING 8      /* nesting depth of inlined lists */
#define MAX_LOOKED (4 * MAX_OPS) /* bounds the search if lists call many lists with few ops */
#define MAX_PUSHES 32
#define MAX_MADE 16        /* most effects derived from one list; beyond that it changes too often */

enum action {
	KEEP,   /* may read or write anything */
	CHANGE, /* changes only the current matrix */
	PUSH,
	POP,
	BIND,
	CALL,
	PASS, /* only sets attributes */
	DRAW, /* a mesh: only its attributes matter */
	LEAVE /* may change the meaning of what follows: matrix stack, texture unit, edge flag, an open Begin */
};

struct maker {
	struct gls_state *st;
	const struct gls_op **ops;
	uint8_t *action, *dead;
	uint32_t *rest; /* for a DRAW: attributes that no later op has set again */
	uint32_t n, room;
	uint32_t last[N_GLS_ATTRIBUTES], bound[N_GLS_TEXTURE_TARGETS]; /* 1 + op that set it last, if nothing has read
	                                                                  it since */
	uint32_t push[MAX_PUSHES], depth, read; /* unclosed pushes; the first `read` of them contain an op that reads */
	uint32_t most, nesting, looked;
	int left, failed;
};

static enum action action_of(const struct gls_op *op)
{
	static const uint8_t known[] = {
		[GLS_ROLE_TRANSFORM] = CHANGE, [GLS_ROLE_CALL_LIST] = CALL, [GLS_ROLE_BIND_TEXTURE] = BIND,
		[GLS_ROLE_PUSH_MATRIX] = PUSH, [GLS_ROLE_POP_MATRIX] = POP, [GLS_ROLE_SELECT] = LEAVE, [GLS_ROLE_EDGE_FLAG] = LEAVE,
		[GLS_ROLE_BEGIN] = LEAVE, [GLS_ROLE_END] = LEAVE, [GLS_ROLE_MATERIAL] = KEEP, [GLS_ROLE_VERTEX_ATTRIB] = PASS,
	};
	const struct gls_command *k = &gls_commands[op->command];

	if (op->form == GLS_OP_MESH)
		return DRAW;
	if (k->role != GLS_ROLE_NONE)
		return known[k->role];
	return k->kind == GLS_KIND_VERTEX ? PASS : k->kind == GLS_KIND_INSIDE ? LEAVE : KEEP;
}

static int make_room(struct maker *m)
{
	uint32_t room = m->room ? 2 * m->room : 256;
	void *ops, *action, *dead, *rest;

	if (m->n < m->room)
		return 0;
	if (m->n >= MAX_OPS)
		return ERR_SYSTEM;
	if ((ops = realloc(m->ops, room * sizeof(*m->ops))))
		m->ops = ops;
	if ((action = realloc(m->action, room)))
		m->action = action;
	if ((dead = realloc(m->dead, room)))
		m->dead = dead;
	if ((rest = realloc(m->rest, room * sizeof(*m->rest))))
		m->rest = rest;
	if (!ops || !action || !dead || !rest)
		return ERR_SYSTEM;
	m->room = room;
	return 0;
}

/* An op may read anything set before it. */
static void read_all(struct maker *m)
{
	memset(m->last, 0, sizeof(m->last));
	memset(m->bound, 0, sizeof(m->bound));
	m->read = m->depth;
}

static void put_draw(struct maker *m, uint32_t at)
{
	const uint32_t sets = m->ops[at]->mesh->before | m->ops[at]->mesh->after;

	m->rest[at] = sets;
	m->dead[at] = !sets;
	for (uint32_t rest = sets; rest; rest &= rest - 1) {
		unsigned a = (unsigned)__builtin_ctz(rest);
		uint32_t earlier = m->last[a];

		if (earlier && !(m->rest[earlier - 1] &= ~(1u << a)))
			m->dead[earlier - 1] = 1;
		m->last[a] = at + 1;
	}
}

/* The target of a bind that neither fails nor creates an object; -1: it may. */
static int target_of(const struct maker *m, const struct gls_op *op)
{
	uint32_t token = op->form == GLS_OP_CALL && op->n == 2 ? (uint32_t)gls_value_int(&op->args[0]) : 0, name;
	const struct gls_texture *t;
	unsigned face;
	int target;

	if (token != GL_TEXTURE_1D && token != GL_TEXTURE_2D && token != GL_TEXTURE_3D && token != GL_TEXTURE_CUBE_MAP)
		return -1;
	target = gls_texture_target_of(token, &face);
	name = (uint32_t)gls_value_int(&op->args[1]);
	t = name ? table_find(&m->st->share->textures, name) : NULL;
	return !name || (t && t->target == (uint32_t)target) ? target : -1;
}

static void put_bind(struct maker *m, uint32_t at)
{
	int target = target_of(m, m->ops[at]);

	if (target < 0) {
		read_all(m);
		return;
	}
	if (m->bound[target])
		m->dead[m->bound[target] - 1] = 1;
	m->bound[target] = at + 1;
}

static void put_push(struct maker *m, uint32_t at)
{
	if (m->depth == MAX_PUSHES) {
		m->failed = 1;
		return;
	}
	m->push[m->depth++] = at;
	m->most = m->depth > m->most ? m->depth : m->most;
}

static void put_pop(struct maker *m, uint32_t at)
{
	if (m->depth == 0)
		return; /* its push came before the list: earlier changes may be redundant as well, but are kept */
	m->depth--;
	if (m->depth < m->read) {
		m->read = m->depth;
		return;
	}
	for (uint32_t i = m->push[m->depth]; i <= at; i++)
		m->dead[i] |= m->action[i] == CHANGE || m->action[i] == PUSH || m->action[i] == POP;
}

static struct gls_list *called_by(const struct maker *m, const struct gls_op *op)
{
	return op->form == GLS_OP_CALL && op->n ?
	               table_find(&m->st->share->lists, (uint32_t)gls_value_int(&op->args[0])) :
	               NULL;
}

/* 1 if some op of the list may change the meaning of later ops. Such a list is called unchanged. */
static int leaves(struct maker *m, const struct gls_list *list, uint32_t nesting)
{
	for (uint32_t i = 0; i < list->n; i++) {
		enum action action = action_of(&list->ops[i]);
		const struct gls_list *called = action == CALL ? called_by(m, &list->ops[i]) : NULL;

		if (++m->looked > MAX_LOOKED || action == LEAVE ||
		    (action == CALL && (!called || nesting == MAX_NESTING || leaves(m, called, nesting + 1))))
			return 1;
	}
	return 0;
}

static void put_list(struct maker *m, const struct gls_list *list, uint32_t nesting);

static void put_op(struct maker *m, const struct gls_op *op, uint32_t nesting)
{
	enum action action = m->left ? KEEP : action_of(op);
	struct gls_list *called;
	uint32_t at = m->n;

	if (action == CALL) {
		called = called_by(m, op);
		if (called && nesting < MAX_NESTING && !leaves(m, called, nesting + 1)) {
			called->inlined = 1;
			put_list(m, called, nesting + 1);
			return;
		}
		action = LEAVE;
	}
	if (make_room(m)) {
		m->failed = 1;
		return;
	}
	m->n++;
	m->ops[at] = op;
	m->action[at] = (uint8_t)action;
	m->dead[at] = 0;
	switch (action) {
	case DRAW: put_draw(m, at); break;
	case BIND: put_bind(m, at); break;
	case PUSH: put_push(m, at); break;
	case POP: put_pop(m, at); break;
	case KEEP:
	case LEAVE:
		read_all(m);
		m->left |= action == LEAVE;
		break;
	default: /* CHANGE, PASS */
		break;
	}
}

static void put_list(struct maker *m, const struct gls_list *list, uint32_t nesting)
{
	m->nesting = nesting > m->nesting ? nesting : m->nesting;
	for (uint32_t i = 0; i < list->n && !m->failed; i++) {
		m->failed = ++m->looked > MAX_LOOKED;
		put_op(m, &list->ops[i], nesting);
	}
}

static void make(struct gls_state *st, struct gls_list *list)
{
	struct maker m = { .st = st };
	struct gls_effect *e = &list->effect;

	e->n = 0;
	e->epoch = st->share->epoch + 1;
	e->none = ++e->n_made > MAX_MADE;
	if (!e->none)
		put_list(&m, list, 0);
	for (uint32_t i = 0; i < m.n && !m.failed; i++)
		e->n += !m.dead[i];
	free(e->ops);
	e->ops = e->none || m.failed ? NULL : malloc((e->n + !e->n) * sizeof(*e->ops));
	e->none |= !e->ops;
	e->pushes = m.most;
	e->nesting = m.nesting;
	for (uint32_t i = 0, to = 0; i < m.n && !e->none; i++)
		if (!m.dead[i])
			e->ops[to++] = *m.ops[i];
	free(m.ops);
	free(m.action);
	free(m.dead);
	free(m.rest);
}

const struct gls_effect *gls_effect_of(const struct gls_exec *x, struct gls_state *st, struct gls_list *list)
{
	const struct gls_matrix_stack *stack = gls_current_stack(st);
	const struct gls_effect *e = &list->effect;

	if (x->want || st->begin_mode || !st->a.current.edge_flag || x->pending.geometry.n_vertices)
		return NULL;
	if (e->epoch != st->share->epoch + 1) {
		if (!list->skipped++)
			return NULL; /* a list that runs only once is not worth it */
		make(st, list);
	}
	return e->none || stack->depth + e->pushes >= stack->max || x->list_depth + e->nesting >= GLS_MAX_LIST_NESTING ?
	               NULL :
	               e;
}
