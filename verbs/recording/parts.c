#include "verbs/recording/parts.h"

#include <string.h>

#include "gl_tokens.h"

enum { NO_ARGUMENT = -1, MOST_ARGUMENTS = 16, MOST_VERTICES = 1 << 24 };

/* Draws and images, with the indices of their arguments. */
static const struct shape {
	const char *name;
	int first, count, type, indices; /* for a draw, whose first argument is the mode */
	int pixels;                      /* for an image */
} shapes[] = {
	{ "glDrawArrays", 1, 2, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT },
	{ "glDrawArraysEXT", 1, 2, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT },
	{ "glDrawElements", NO_ARGUMENT, 1, 2, 3, NO_ARGUMENT },
	{ "glDrawRangeElements", NO_ARGUMENT, 3, 4, 5, NO_ARGUMENT },
	{ "glDrawRangeElementsEXT", NO_ARGUMENT, 3, 4, 5, NO_ARGUMENT },
	{ "glTexImage1D", NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, 7 },
	{ "glTexImage2D", NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, 8 },
	{ "glTexImage3D", NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, 9 },
	{ "glTexImage3DEXT", NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, NO_ARGUMENT, 9 },
};

/*
 * By mode (GL 2.1 sec. 2.6.1): vertices from one part to the next, and the number of further vertices that a part
 * needs. Loops, fans and polygons are not divided.
 */
static const struct step {
	uint32_t step, beyond;
} steps[] = {
	[GL_POINTS] = { 1, 0 }, [GL_LINES] = { 2, 0 }, [GL_LINE_STRIP] = { 1, 1 }, [GL_TRIANGLES] = { 3, 0 },
	[GL_TRIANGLE_STRIP] = { 2, 2 }, [GL_QUADS] = { 4, 0 }, [GL_QUAD_STRIP] = { 2, 2 },
};

static const struct shape *shape_of(const struct call *call)
{
	for (size_t i = 0; i < sizeof(shapes) / sizeof(shapes[0]); i++)
		if (strcmp(call->sig->name, shapes[i].name) == 0)
			return &shapes[i];
	return NULL;
}

static uint64_t number(const struct call *call, int argument)
{
	const struct trace_value *v = &call->args[argument];

	return v->type == TRACE_UINT || v->type == TRACE_ENUM ? v->u : UINT64_MAX;
}

static const struct step *step_of(const struct call *call)
{
	const uint64_t mode = number(call, 0);

	return mode < sizeof(steps) / sizeof(steps[0]) && steps[mode].step ? &steps[mode] : NULL;
}

static uint64_t index_bytes(const struct call *call, const struct shape *s)
{
	switch (number(call, s->type)) {
	case GL_UNSIGNED_BYTE: return 1;
	case GL_UNSIGNED_SHORT: return 2;
	case GL_UNSIGNED_INT: return 4;
	default: return 0;
	}
}

/* Can the indices be divided? They are in the call or in a buffer. */
static int has_indices(const struct call *call, const struct shape *s, uint64_t count)
{
	const struct trace_value *v = &call->args[s->indices];
	const uint64_t bytes = index_bytes(call, s);

	return bytes && (v->type == TRACE_NULL || v->type == TRACE_UINT || v->type == TRACE_OPAQUE ||
	                 (v->type == TRACE_BLOB && v->count / bytes >= count));
}

size_t parts_count(const struct call *call)
{
	const struct shape *s = shape_of(call);
	const struct step *step;
	uint64_t count;

	if (!s || call->n_args > MOST_ARGUMENTS)
		return 0;
	if (s->pixels != NO_ARGUMENT)
		return call->args[s->pixels].type == TRACE_BLOB;
	step = step_of(call);
	count = number(call, s->count);
	if (!step || count > MOST_VERTICES || count <= step->beyond ||
	    (s->first != NO_ARGUMENT && number(call, s->first) >= UINT32_MAX) ||
	    (s->indices != NO_ARGUMENT && !has_indices(call, s, count)))
		return 0;
	return (count - step->beyond + step->step - 1) / step->step;
}

/*
 * The next run of remaining parts. end: end of the previous run; receives the end of this one @return its beginning; n:
 * there is none
 */
static size_t next_run(const uint8_t *in, size_t n, size_t *end)
{
	size_t begin = *end;

	while (begin < n && !in[begin])
		begin++;
	for (*end = begin; *end < n && in[*end];)
		++*end;
	return begin;
}

size_t parts_calls(const struct call *call, const uint8_t *in)
{
	const size_t n = parts_count(call);
	size_t calls = 0, end = 0;

	if (shape_of(call)->pixels != NO_ARGUMENT)
		return 1;
	while (next_run(in, n, &end) < n)
		calls++;
	return calls;
}

/* The draw reduced to the parts from begin to end. */
static void cut(const struct call *call, const struct shape *s, size_t begin, size_t end, struct trace_value *args)
{
	const struct step *step = step_of(call);
	const uint64_t skipped = begin * step->step, count = number(call, s->count) - skipped;
	const uint64_t kept = (end - begin) * step->step + step->beyond,
		       bytes = s->indices != NO_ARGUMENT ? index_bytes(call, s) : 0;

	args[s->count].u = kept < count ? kept : count;
	if (s->first != NO_ARGUMENT) {
		args[s->first].u += skipped;
	} else if (args[s->indices].type == TRACE_BLOB) {
		args[s->indices].blob += skipped * bytes;
		args[s->indices].count = args[s->count].u * bytes;
	} else {
		args[s->indices].u = (args[s->indices].type == TRACE_NULL ? 0 : args[s->indices].u) + skipped * bytes;
		args[s->indices].type = TRACE_OPAQUE;
	}
}

int parts_write(struct trace_out *out, const struct call *call, const uint8_t *in)
{
	const struct shape *s = shape_of(call);
	const size_t n = parts_count(call);
	struct trace_value args[MOST_ARGUMENTS];
	struct call changed = *call;
	int err = 0;

	if (memchr(in, 0, n) == NULL)
		return trace_out_call(out, call);
	changed.args = args;
	if (s->pixels != NO_ARGUMENT) {
		memcpy(args, call->args, call->n_args * sizeof(*args));
		args[s->pixels] = (struct trace_value){ .type = TRACE_NULL };
		return trace_out_call(out, &changed);
	}
	for (size_t end = 0, begin; !err && (begin = next_run(in, n, &end)) < n;) {
		memcpy(args, call->args, call->n_args * sizeof(*args));
		cut(call, s, begin, end, args);
		err = trace_out_call(out, &changed);
	}
	return err;
}
