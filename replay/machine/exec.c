/* struct call -> handler, and what happens around every handler. */
#include "replay/machine/exec.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define MAX_THREADS 65536

const struct trace_value gls_no_value = { .type = TRACE_NONE };

int32_t gls_command_find(const char *name)
{
	uint32_t lo = 0, hi = n_gls_commands;

	while (lo < hi) {
		uint32_t mid = (lo + hi) / 2;
		int order = strcmp(name, gls_commands[mid].name);
		if (order == 0)
			return (int32_t)mid;
		if (order < 0)
			hi = mid;
		else
			lo = mid + 1;
	}
	return -1;
}

/* ---- arguments ---- */

double gls_value_double(const struct trace_value *v)
{
	switch (v->type) {
	case TRACE_FLOAT:
		return v->f;
	case TRACE_DOUBLE:
		return v->d;
	case TRACE_SINT:
	case TRACE_ENUM:
		return (double)v->i;
	case TRACE_TRUE:
		return 1;
	case TRACE_UINT:
	case TRACE_BITMASK:
	case TRACE_OPAQUE:
		return (double)v->u;
	case TRACE_REPR:
		return gls_value_double(&v->items[1]);
	case TRACE_ARRAY:
		return v->count ? gls_value_double(&v->items[0]) : 0;
	default:
		return 0;
	}
}

int64_t gls_value_int(const struct trace_value *v)
{
	double d;

	switch (v->type) {
	case TRACE_SINT:
	case TRACE_ENUM:
		return v->i;
	case TRACE_UINT:
	case TRACE_BITMASK:
	case TRACE_OPAQUE:
		return (int64_t)v->u;
	default:
		d = gls_value_double(v);
		return d >= -9e18 && d <= 9e18 ? (int64_t)d : 0;
	}
}

unsigned arg_floats(const struct call *c, unsigned i, float *out, unsigned n)
{
	const struct trace_value *v = arg(c, i);
	unsigned got;

	if (v->type != TRACE_ARRAY) {
		if (v->type == TRACE_NONE || v->type == TRACE_NULL || v->type == TRACE_BLOB || v->type == TRACE_OPAQUE || !n)
			return 0;
		out[0] = (float)gls_value_double(v);
		return 1;
	}
	for (got = 0; got < n && got < v->count; got++) {
		const struct trace_value *item = &v->items[got];
		out[got] = item->type == TRACE_FLOAT ? item->f : (float)gls_value_double(item);
	}
	return got;
}

unsigned arg_uints(const struct call *c, unsigned i, uint32_t *out, unsigned n)
{
	const struct trace_value *v = arg(c, i);
	unsigned got;

	if (v->type != TRACE_ARRAY) {
		if (v->type == TRACE_NONE || v->type == TRACE_NULL || v->type == TRACE_BLOB || v->type == TRACE_OPAQUE || !n)
			return 0;
		out[0] = (uint32_t)gls_value_int(v);
		return 1;
	}
	for (got = 0; got < n && got < v->count; got++)
		out[got] = (uint32_t)gls_value_int(&v->items[got]);
	return got;
}

const struct trace_value *arg_items(const struct call *c, unsigned i, uint64_t *n)
{
	const struct trace_value *v = arg(c, i);

	*n = v->type == TRACE_ARRAY ? v->count : 0;
	return *n ? v->items : NULL;
}

const uint8_t *arg_blob(const struct call *c, unsigned i, size_t *n)
{
	const struct trace_value *v = arg(c, i);

	*n = v->type == TRACE_BLOB ? v->count : 0;
	return v->type == TRACE_BLOB ? v->blob : NULL;
}

int arg_is_offset(const struct call *c, unsigned i)
{
	enum trace_type type = arg(c, i)->type;

	return type == TRACE_OPAQUE || type == TRACE_NULL || type == TRACE_UINT;
}

/* ---- errors, counts, memory ---- */

void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error)
{
	gls_set_error(st, error);
	x->errors[x->command]++;
	x->error_code[x->command] = error;
}

void gls_unsupported(struct gls_exec *x, const char *why)
{
	x->unsupported[x->command]++;
	x->why[x->command] = why;
}

void gls_out_of_memory(struct gls_exec *x, size_t bytes)
{
	if (!x->failed)
		x->failed = err_report(ERR_SYSTEM, x->path, "out of memory for %zu bytes at call %llu (%s)", bytes,
		                       x->call ? (unsigned long long)x->call->number : 0, gls_commands[x->command].name);
}

void *gls_scratch(struct gls_exec *x, size_t n)
{
	if (n > x->scratch_room) {
		uint8_t *grown = realloc(x->scratch, n);
		if (!grown) {
			gls_out_of_memory(x, n);
			return NULL;
		}
		x->scratch = grown;
		x->scratch_room = n;
	}
	return x->scratch;
}

/* ---- dispatch ---- */

void gls_flush(struct gls_exec *x)
{
	struct gls_geometry *g = &x->geometry;
	struct gls_mesh *mesh;
	uint32_t list = x->drawn_list;

	if (g->n_primitives && x->st) {
		if (g->quads && !x->pending_list && gls_quads_turn(x->st, g->position, g->n_vertices))
			gls_geometry_turn_quads(g);
		mesh = gls_geometry_mesh(x, g);
		x->drawn_list = x->pending_list;
		if (mesh)
			gls_frame_add(x, x->st, mesh, (const float (*)[4])g->constant, x->pending_command, x->pending_call);
		x->drawn_list = list;
		gls_mesh_release(mesh);
	}
	gls_geometry_clear(g);
}

enum { OUTSIDE = 1, DRAW_PENDING = 2, STALE = 4 };

void gls_dispatch(struct gls_exec *x, const struct call *c, uint32_t command)
{
	/* What each kind asks for (exec.h); all of it means outside Begin/End. */
	static const uint8_t rules[] = {
		[GLS_KIND_STATE] = OUTSIDE | DRAW_PENDING | STALE, [GLS_KIND_MATRIX] = OUTSIDE | DRAW_PENDING,
		[GLS_KIND_ARRAY] = OUTSIDE | DRAW_PENDING, [GLS_KIND_NOW] = OUTSIDE, [GLS_KIND_WINDOW] = 0,
	};
	const struct gls_command *k = &gls_commands[command];
	struct gls_state *st = x->st;

	x->command = command;
	if (k->kind == GLS_KIND_NONE)
		return;
	if (rules[k->kind]) {
		if (st->begin_mode) {
			gls_error(x, st, GL_INVALID_OPERATION);
			return;
		}
		if (rules[k->kind] & DRAW_PENDING && x->geometry.n_vertices)
			gls_flush(x);
		if (rules[k->kind] & STALE)
			st->dirty |= GLS_DIRTY_ALL;
	}
	k->handler(x, st, c);
}

static int is_kept_in_lists(uint32_t kind)
{
	return kind == GLS_KIND_VERTEX || kind == GLS_KIND_INSIDE || kind == GLS_KIND_STATE || kind == GLS_KIND_MATRIX;
}

static int switch_thread(struct gls_exec *x, uint64_t thread)
{
	if (thread >= MAX_THREADS)
		return err_report(ERR_INPUT, x->path, "call %llu: thread number %llu makes no sense",
		                  (unsigned long long)x->call->number, (unsigned long long)thread);
	if (x->st)
		gls_flush(x);
	if (thread >= x->n_threads) {
		struct gls_context **grown = realloc(x->threads, (thread + 1) * sizeof(*grown));
		if (!grown)
			return err_report(ERR_SYSTEM, x->path, "out of memory");
		memset(grown + x->n_threads, 0, (thread + 1 - x->n_threads) * sizeof(*grown));
		x->threads = grown;
		x->n_threads = thread + 1;
	}
	x->thread = thread;
	x->current = x->threads[thread];
	x->st = x->current ? &x->current->state : NULL;
	return 0;
}

int gls_exec_call(struct gls_exec *x, const struct call *c)
{
	const struct gls_command *k;
	int32_t command = c->sig->command;
	int rc;

	x->call = c;
	x->n_calls++;
	if (command < 0) {
		/* Keyed by the signature, which lives as long as the reader. */
		uint64_t n = (uintptr_t)table_find(&x->unknown, (uintptr_t)c->sig);
		return table_set(&x->unknown, (uintptr_t)c->sig, (void *)(uintptr_t)(n + 1));
	}
	k = &gls_commands[command];
	x->command = (uint32_t)command;
	x->count[command]++;
	if ((c->thread != x->thread || !x->threads) && (rc = switch_thread(x, c->thread)))
		return rc;
	if (x->current)
		x->current->calls++;
	if (!k->handler) {
		x->unsupported[command] += !k->excuse;
		return 0;
	}
	if (k->kind != GLS_KIND_WINDOW) {
		if (!x->st) {
			x->without_context++;
			return 0;
		}
		if (x->st->list && is_kept_in_lists(k->kind)) {
			if (gls_list_append(x, x->st, c))
				return ERR_SYSTEM;
			if (x->st->list_mode == GL_COMPILE)
				return 0;
		}
	}
	gls_dispatch(x, c, (uint32_t)command);
	return x->failed;
}

/* ---- life ---- */

int gls_exec_create(struct gls_exec **out, const char *path)
{
	struct gls_exec *x = calloc(1, sizeof(*x));

	*out = NULL;
	if (!x)
		return err_report(ERR_SYSTEM, path, "out of memory");
	x->path = path;
	x->count = calloc(n_gls_commands, sizeof(*x->count));
	x->unsupported = calloc(n_gls_commands, sizeof(*x->unsupported));
	x->errors = calloc(n_gls_commands, sizeof(*x->errors));
	x->why = calloc(n_gls_commands, sizeof(*x->why));
	x->error_code = calloc(n_gls_commands, sizeof(*x->error_code));
	if (!x->count || !x->unsupported || !x->errors || !x->why || !x->error_code ) {
		gls_exec_destroy(&x);
		return err_report(ERR_SYSTEM, path, "out of memory");
	}
	*out = x;
	return 0;
}

void gls_exec_take_counts(struct gls_exec *x, struct gls_exec *other)
{
	struct gls_exec mine = *x;

	x->count = other->count;
	x->unsupported = other->unsupported;
	x->errors = other->errors;
	x->why = other->why;
	x->error_code = other->error_code;
	x->unknown = other->unknown;
	other->count = mine.count;
	other->unsupported = mine.unsupported;
	other->errors = mine.errors;
	other->why = mine.why;
	other->error_code = mine.error_code;
	other->unknown = mine.unknown;
}

void gls_exec_destroy(struct gls_exec **exec)
{
	struct gls_exec *x = *exec;

	if (!x)
		return;
	for (size_t i = 0; i < x->n_contexts; i++) {
		gls_state_free(&x->contexts[i]->state);
		free(x->contexts[i]);
	}
	free(x->contexts);
	free(x->threads);
	for (size_t i = 0; i < x->drawables.room; i++)
		if (x->drawables.entries[i].value) {
			gls_surface_free(&((struct gls_drawable *)x->drawables.entries[i].value)->surface);
			gls_surface_free(&((struct gls_drawable *)x->drawables.entries[i].value)->front);
			free(((struct gls_drawable *)x->drawables.entries[i].value)->accum);
			free(x->drawables.entries[i].value);
		}
	table_free(&x->drawables);
	table_free(&x->configs);
	gls_geometry_free(&x->geometry);
	gls_geometry_free(&x->compiling);
	free(x->assembling);
	gls_mesh_cache_free(x);
	gls_image_cache_free(x);
	table_free(&x->maps);
	table_free(&x->unknown);
	free(x->scratch);
	free(x->elements);
	free(x->count);
	free(x->unsupported);
	free(x->errors);
	free(x->why);
	free(x->error_code);
	free(x);
	*exec = NULL;
}
