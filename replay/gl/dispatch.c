/* Dispatches calls to handlers, and does what a command's kind requires. The top layer of the chapters. */
#include "replay/gl/dispatch.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/gl/context.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/list_assemble.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/state/attrib.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/surface.h"
#include "replay/gl/texture/image.h"
#include "replay/machine/args.h"
#include "replay/machine/errors.h"
#include "replay/machine/fixed.h"
#include "replay/machine/machine.h"
#include "replay/programs/program.h"
#include "scene/mesa.h"

#define MAX_THREADS 65536

enum { OUTSIDE = 1, DRAW_PENDING = 2, STALE = 4 };

/* 1 for a glEnable or glDisable that changes nothing. */
static int changes_nothing(struct gls_state *st, const struct call *c, uint32_t command)
{
	const int enables = gls_handlers[command] == gls_glEnable;

	return (enables || gls_handlers[command] == gls_glDisable) && gls_is_switched(st, arg_u(c, 0), enables);
}

static void dispatch(struct gls_exec *x, const struct call *c, uint32_t command, const struct gls_pixel_store *unpack)
{
	/* Requirements of each kind (commands.h); they apply outside Begin/End. */
	static const uint8_t rules[] = {
		[GLS_KIND_STATE] = OUTSIDE | DRAW_PENDING | STALE, [GLS_KIND_MATRIX] = OUTSIDE | DRAW_PENDING,
		[GLS_KIND_ARRAY] = OUTSIDE | DRAW_PENDING, [GLS_KIND_NOW] = OUTSIDE,
		[GLS_KIND_OBJECT] = OUTSIDE | DRAW_PENDING | STALE, [GLS_KIND_WINDOW] = 0,
	};
	const struct gls_command *k = &gls_commands[command];
	struct gls_state *st = x->st;

	x->command = command;
	x->unpack = unpack;
	if (rules[k->kind]) {
		const int is_pending = x->pending.geometry.n_vertices || st->waiting.stored;

		if (gls_refuses(x, st, st->begin_mode, GL_INVALID_OPERATION))
			return;
		if (rules[k->kind] & DRAW_PENDING && is_pending && !changes_nothing(st, c, command))
			gls_flush(x);
		if (rules[k->kind] & STALE)
			st->dirty |= GLS_DIRTY_ALL;
	}
	if (k->kind == GLS_KIND_ARRAY || k->role == GLS_ROLE_BEGIN || k->role == GLS_ROLE_CALL_LIST)
		gls_program_draws(st);
	gls_handlers[command](x, st, c);
}

static int is_kept_in_lists(uint32_t kind)
{
	return kind == GLS_KIND_VERTEX || kind == GLS_KIND_INSIDE || kind == GLS_KIND_STATE || kind == GLS_KIND_MATRIX;
}

static int switch_thread(struct gls_exec *x, uint64_t thread)
{
	if (thread >= MAX_THREADS)
		return err_report(ERR_INPUT, x->path, "call %llu: thread number %llu is invalid",
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
	x->current = x->threads[thread]; /* NOLINT(clang-analyzer-core.NullDereference): thread < n_threads */
	x->st = x->current ? &x->current->state : NULL;
	return 0;
}

/* 1 for the recorder's own markers: they say what is so now, whatever list is being made. Materials, which the program
 * sets by capture/relume.h, belong to its lists. */
static int is_recorders_own(const struct gls_command *k, const struct call *c)
{
	static const char own[] = "relume:", material[] = "relume:material ";
	const struct trace_value *v = k->role == GLS_ROLE_MARKER ? arg(c, 1) : NULL;
	const char *text = !v ? NULL : v->type == TRACE_STRING ? v->str : v->type == TRACE_BLOB ? (const char *)v->blob : NULL;

	return text && v->count >= sizeof(own) - 1 && memcmp(text, own, sizeof(own) - 1) == 0 &&
	       !(v->count >= sizeof(material) - 1 && memcmp(text, material, sizeof(material) - 1) == 0);
}

/* 1 for a bitmap of no pixels in a list, as blanks of fonts are: Mesa 22.3 leaves it out, with GL_OUT_OF_MEMORY. */
static int is_lost_in_lists(const struct gls_state *st, const struct gls_command *k, const struct call *c)
{
	return k->role == GLS_ROLE_BITMAP && c->n_args && c->args[c->n_args - 1].type == TRACE_NULL &&
	       !st->client.unpack.buffer && gls_is_mesa(st) && !(st->mesa & SCENE_MESA_KEEPS_BITMAPS);
}

int gls_exec_call(struct gls_exec *x, const struct call *c)
{
	const struct gls_command *k;
	struct gls_fixed fixed;
	int32_t command = c->sig->command;
	int rc;

	x->call = c;
	x->n_calls++;
	if (command < 0) {
		/* Keyed by the signature, which lives as long as the reader. */
		uint64_t n = (uintptr_t)table_find(&x->counts.unknown, (uintptr_t)c->sig);
		return table_set(&x->counts.unknown, (uintptr_t)c->sig, (void *)(uintptr_t)(n + 1));
	}
	k = &gls_commands[command];
	if (k->fixed)
		c = gls_fixed_to_float(&fixed, c, k->fixed);
	x->command = (uint32_t)command;
	x->counts.calls[command]++;
	if ((c->thread != x->thread || !x->threads) && (rc = switch_thread(x, c->thread)))
		return rc;
	if (x->current)
		x->current->calls++;
	if (!k->kind) {
		x->counts.unsupported[command] += !k->excuse;
		return 0;
	}
	if (k->kind != GLS_KIND_WINDOW) {
		if (!x->st) {
			x->without_context++;
			return 0;
		}
		if (x->st->list && is_kept_in_lists(k->kind) && !is_recorders_own(k, c)) {
			if (is_lost_in_lists(x->st, k, c)) {
				gls_error(x, x->st, GL_OUT_OF_MEMORY);
				return 0;
			}
			if (gls_list_append(x, x->st, c, (uint32_t)command))
				return ERR_SYSTEM;
			if (x->st->list_mode == GL_COMPILE)
				return 0;
		}
	}
	dispatch(x, c, (uint32_t)command, NULL);
	return x->failed;
}

/* ---- creation and destruction ---- */

int gls_exec_create(struct gls_exec **out, const char *path)
{
	struct gls_exec *x = calloc(1, sizeof(*x));

	*out = NULL;
	if (!x)
		return err_report(ERR_SYSTEM, path, "out of memory");
	x->path = path;
	x->dispatch = dispatch;
	x->counts.calls = calloc(n_gls_commands, sizeof(*x->counts.calls));
	x->counts.unsupported = calloc(n_gls_commands, sizeof(*x->counts.unsupported));
	x->counts.errors = calloc(n_gls_commands, sizeof(*x->counts.errors));
	x->counts.why = calloc(n_gls_commands, sizeof(*x->counts.why));
	x->counts.error_code = calloc(n_gls_commands, sizeof(*x->counts.error_code));
	if (!x->counts.calls || !x->counts.unsupported || !x->counts.errors || !x->counts.why || !x->counts.error_code ) {
		gls_exec_destroy(&x);
		return err_report(ERR_SYSTEM, path, "out of memory");
	}
	*out = x;
	return 0;
}

void gls_exec_take_counts(struct gls_exec *x, struct gls_exec *other)
{
	struct gls_counts mine = x->counts;

	x->counts = other->counts;
	other->counts = mine;
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
	gls_geometry_free(&x->pending.geometry);
	gls_geometry_free(&x->scratch.geometry);
	gls_assembler_free(x->assembler);
	gls_mesh_cache_free(x);
	gls_image_cache_free(x);
	table_free(&x->maps);
	table_free(&x->counts.unknown);
	table_free(&x->counts.program_draws);
	free(x->scratch.bytes);
	free(x->scratch.elements);
	free(x->counts.calls);
	free(x->counts.unsupported);
	free(x->counts.errors);
	free(x->counts.why);
	free(x->counts.error_code);
	for (uint32_t i = 0; i < x->counts.n_reasons; i++)
		free(x->counts.reasons[i]);
	free(x->counts.reasons);
	free(x);
	*exec = NULL;
}
