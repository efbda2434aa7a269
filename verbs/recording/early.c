#include "verbs/recording/early.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"

enum { MAX_THREADS = 256, MAX_ATTRIBUTES = 64, MAX_ITEMS = 16, ATTRIBUTE_ARGS = 6 };

/* A call that sets a current attribute, held until it is known whether it is the last one. */
struct attribute {
	struct call call;
	struct trace_value args[ATTRIBUTE_ARGS], items[MAX_ITEMS];
	int64_t target; /* first argument, if that selects the attribute */
};

struct early {
	struct trace_out *out;
	uint64_t n_put;
	struct {
		uint8_t compiling;  /* 1: in a display list */
		uint8_t selecting;  /* 1: in selection or feedback mode, where nothing is drawn */
		uint8_t begin_held; /* 1: Begin is held back until something has to be written inside it */
		uint8_t drawing;    /* 1: Begin was written, and End was not */
		uint8_t discarding; /* 1: we have enabled RASTERIZER_DISCARD */
		uint8_t discards;   /* 1: the program has enabled it */
		struct call begin;
		struct trace_value mode;
	} threads[MAX_THREADS];
	struct attribute attributes[MAX_ATTRIBUTES]; /* all of one thread, in call order */
	size_t n_attributes;
};

static int64_t number(const struct call *call, unsigned arg)
{
	return arg < call->n_args ? gls_value_int(&call->args[arg]) : 0;
}

static int begins_with(const struct call *call, const char *name)
{
	return strncmp(call->sig->name, name, strlen(name)) == 0;
}

static int is(const struct call *call, const char *name)
{
	return strcmp(call->sig->name, name) == 0;
}

static uint32_t kind_of(const struct call *call)
{
	return call->sig->command < 0 ? GLS_KIND_NONE : gls_commands[call->sig->command].kind;
}

/* ---- writing ---- */

static int put(struct early *e, const struct call *call)
{
	e->n_put++;
	return trace_out_call(e->out, call);
}

static int put_attributes(struct early *e)
{
	int rc = 0;

	for (size_t i = 0; i < e->n_attributes && !rc; i++)
		rc = put(e, &e->attributes[i].call);
	e->n_attributes = 0;
	return rc;
}

/* Write a glEnable or glDisable that is not in the original. */
static int put_discard(struct early *e, uint64_t thread, int on)
{
	static const char *arg_names[] = { "cap" }, *names[] = { "GL_RASTERIZER_DISCARD" };
	static uint64_t values[] = { GL_RASTERIZER_DISCARD };
	static const struct trace_values_sig caps = { 1, names, values };
	static const struct call_sig sigs[] = { { .name = "glDisable", .n_args = 1, .arg_names = arg_names },
		                                { .name = "glEnable", .n_args = 1, .arg_names = arg_names } };
	const struct trace_value cap = { .type = TRACE_ENUM, .sig = &caps, .i = GL_RASTERIZER_DISCARD };
	const struct call call = { .thread = thread, .flags = CALL_FAKE, .sig = &sigs[on], .n_args = 1, .args = &cap,
		                   .ret = { .type = TRACE_NONE } };

	e->threads[thread].discarding = (uint8_t)on;
	return e->threads[thread].discards ? 0 : put(e, &call);
}

static int put_held_begin(struct early *e, uint64_t thread)
{
	if (!e->threads[thread].begin_held)
		return 0;
	e->threads[thread].begin_held = 0;
	e->threads[thread].drawing = 1;
	e->threads[thread].begin.args = &e->threads[thread].mode;
	return put(e, &e->threads[thread].begin);
}

/* Write a call whose drawing must not be visible. */
static int put_unseen(struct early *e, const struct call *call)
{
	uint64_t thread = call->thread;
	int rc = put_attributes(e);

	if (!rc && !e->threads[thread].discarding && !e->threads[thread].drawing)
		rc = put_discard(e, thread, 1);
	rc = rc ? rc : put_held_begin(e, thread);
	return rc ? rc : put(e, call);
}

/*
 * Write any other call. Discarding may stay enabled only for calls that neither read nor write pixels, nor change
 * contexts.
 */
static int put_plain(struct early *e, const struct call *call)
{
	uint32_t kind = kind_of(call);
	int rc = put_attributes(e);

	if (!rc && e->threads[call->thread].discarding && !e->threads[call->thread].drawing && kind != GLS_KIND_VERTEX &&
	    kind != GLS_KIND_INSIDE && kind != GLS_KIND_MATRIX)
		rc = put_discard(e, call->thread, 0);
	return rc ? rc : put(e, call);
}

/* ---- calls of earlier frames ---- */

/* 1 if the first argument selects the attribute that is set. */
static int has_target(const struct call *call)
{
	return begins_with(call, "glMultiTexCoord") || begins_with(call, "glVertexAttrib");
}

/* Hold a call, replacing an earlier one for the same attribute. @return 1 held; 0 the call has an unusual form */
static int hold_attribute(struct early *e, const struct call *call)
{
	int64_t target = has_target(call) ? number(call, 0) : 0;
	struct attribute *a = e->attributes;
	size_t n_items = 0;

	if (call->n_args > ATTRIBUTE_ARGS)
		return 0;
	for (uint32_t i = 0; i < call->n_args; i++) {
		const struct trace_value *v = &call->args[i];

		if (v->type == TRACE_ARRAY ? n_items || v->count > MAX_ITEMS : v->type > TRACE_DOUBLE && v->type != TRACE_ENUM)
			return 0;
		for (uint64_t k = 0; v->type == TRACE_ARRAY && k < v->count; k++)
			if (v->items[k].type > TRACE_DOUBLE && v->items[k].type != TRACE_ENUM)
				return 0;
		n_items += v->type == TRACE_ARRAY;
	}
	while (a < e->attributes + e->n_attributes && (a->call.sig != call->sig || a->target != target))
		a++;
	if (a < e->attributes + e->n_attributes) {
		memmove(a, a + 1, (size_t)(e->attributes + e->n_attributes - a - 1) * sizeof(*a));
		e->n_attributes--;
	} else if (e->n_attributes == MAX_ATTRIBUTES) {
		return 0;
	}
	a = &e->attributes[e->n_attributes++];
	a->call = *call;
	a->target = target;
	for (uint32_t i = 0; i < call->n_args; i++) {
		a->args[i] = call->args[i];
		if (call->args[i].type == TRACE_ARRAY)
			memcpy(a->items, call->args[i].items, (size_t)call->args[i].count * sizeof(a->items[0]));
	}
	/* The held calls may have moved in their array: update their pointers. */
	for (size_t i = 0; i < e->n_attributes; i++) {
		struct attribute *held = &e->attributes[i];

		held->call.args = held->args;
		for (uint32_t k = 0; k < held->call.n_args; k++)
			if (held->args[k].type == TRACE_ARRAY)
				held->args[k].items = held->items;
	}
	return 1;
}

/* A bitmap moves the raster position; without an image it does nothing else (GL 2.1 sec. 3.7). */
static int put_move(struct early *e, const struct call *call)
{
	struct trace_value args[7];
	struct call move = *call;

	if (call->n_args != 7)
		return put_unseen(e, call);
	memcpy(args, call->args, sizeof(args));
	args[0] = args[1] = (struct trace_value){ .type = TRACE_UINT };
	args[6] = (struct trace_value){ .type = TRACE_NULL };
	move.args = args;
	return put_plain(e, &move);
}

/* Recorders write client arrays before each draw: if the draw is dropped, they are not needed. */
static int is_array_of_draw(const struct call *call)
{
	size_t n = strlen(call->sig->name);

	if (!(call->flags & CALL_FAKE) || !call->n_args || call->args[call->n_args - 1].type != TRACE_BLOB)
		return 0;
	return (n > 7 && strcmp(call->sig->name + n - 7, "Pointer") == 0) || strstr(call->sig->name, "PointerEXT") != NULL;
}

static int is_time(const struct call *call)
{
	static const char text[] = "relume:time ";

	if (!is(call, "glStringMarkerGREMEDY"))
		return 0;
	for (uint32_t i = 0; i < call->n_args; i++)
		if (call->args[i].type == TRACE_STRING && strncmp(call->args[i].str, text, sizeof(text) - 1) == 0)
			return 1;
	return 0;
}

/* Lists are kept unchanged. The drawing of one that executes while it is compiled is discarded. */
static int put_list_call(struct early *e, const struct call *call)
{
	uint64_t thread = call->thread;
	int rc;

	if (!is(call, "glNewList"))
		rc = put(e, call);
	else if (number(call, 1) == GL_COMPILE_AND_EXECUTE)
		rc = put_unseen(e, call);
	else
		rc = put_plain(e, call);
	if (!rc && is(call, "glEndList") && e->threads[thread].discarding)
		rc = put_discard(e, thread, 0);
	return rc;
}

static int put_begin_end(struct early *e, const struct call *call)
{
	uint64_t thread = call->thread;
	int held = e->threads[thread].begin_held;

	e->threads[thread].begin_held = is(call, "glBegin");
	if (is(call, "glBegin")) {
		e->threads[thread].begin = *call;
		e->threads[thread].mode = call->args[0];
		return 0;
	}
	if (held)
		return 0;
	held = put_plain(e, call);
	e->threads[thread].drawing = 0;
	return held;
}

/* A clear of no buffers draws nothing, and creates glretrace's window (capture/gl/context.c). */
static int is_clear_of_none(const struct call *call)
{
	return is(call, "glClear") && call->n_args == 1 && gls_value_int(&call->args[0]) == 0;
}

static int put_one(struct early *e, const struct call *call)
{
	uint64_t thread = call->thread;
	int rc;

	if (e->n_attributes && e->attributes[0].call.thread != thread && (rc = put_attributes(e)))
		return rc;
	if (e->threads[thread].compiling || is(call, "glNewList"))
		return put_list_call(e, call);
	if ((call->sig->command >= 0 && gls_commands[call->sig->command].drawing && !is_clear_of_none(call)) ||
	    is_time(call) || is_array_of_draw(call))
		return 0;
	if ((is(call, "glBegin") && call->n_args == 1 && !e->threads[thread].drawing) || is(call, "glEnd"))
		return put_begin_end(e, call);
	if (kind_of(call) == GLS_KIND_VERTEX && hold_attribute(e, call))
		return 0;
	if (begins_with(call, "glCallList") && !e->threads[thread].selecting)
		return put_unseen(e, call);
	return is(call, "glBitmap") ? put_move(e, call) : put_plain(e, call);
}

/* Track the state that decides how later calls are treated. */
static void follow(struct early *e, const struct call *call)
{
	uint64_t thread = call->thread;

	if (is(call, "glNewList"))
		e->threads[thread].compiling = 1;
	else if (is(call, "glEndList"))
		e->threads[thread].compiling = 0;
	else if (is(call, "glRenderMode"))
		e->threads[thread].selecting = number(call, 0) != GL_RENDER;
	else if ((is(call, "glEnable") || is(call, "glDisable")) && number(call, 0) == GL_RASTERIZER_DISCARD)
		e->threads[thread].discards = is(call, "glEnable");
}

int early_put(struct early *e, const struct call *call)
{
	int rc;

	if (call->thread >= MAX_THREADS)
		return err_report(ERR_INPUT, NULL, "call %llu of the trace: more than %d threads", (unsigned long long)call->number,
		                  MAX_THREADS);
	rc = put_one(e, call);
	follow(e, call);
	return rc;
}

int early_end(struct early *e)
{
	int rc = put_attributes(e);

	for (uint64_t thread = 0; thread < MAX_THREADS && !rc; thread++) {
		rc = put_held_begin(e, thread);
		if (!rc && e->threads[thread].discarding)
			rc = put_discard(e, thread, 0);
	}
	return rc;
}

uint64_t early_count(const struct early *e)
{
	return e->n_put;
}

int early_create(struct early **e, struct trace_out *out)
{
	*e = calloc(1, sizeof(**e));
	if (!*e)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	(*e)->out = out;
	return 0;
}

void early_destroy(struct early **e)
{
	free(*e);
	*e = NULL;
}
