#include "replay/machine/args.h"

#include <string.h>

#include "base/norm.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"

const struct trace_value gls_no_value = { .type = TRACE_NONE };

double gls_value_double(const struct trace_value *v)
{
	switch (v->type) {
	case TRACE_FLOAT: return v->f;
	case TRACE_DOUBLE: return v->d;
	case TRACE_SINT: case TRACE_ENUM: return (double)v->i;
	case TRACE_TRUE: return 1;
	case TRACE_UINT: case TRACE_BITMASK: case TRACE_OPAQUE: return (double)v->u;
	case TRACE_REPR: return gls_value_double(&v->items[1]);
	case TRACE_ARRAY: return v->count ? gls_value_double(&v->items[0]) : 0;
	default: return 0;
	}
}

int64_t gls_value_truncated(const struct trace_value *v)
{
	const double d = gls_value_double(v);

	return d >= -9e18 && d <= 9e18 ? (int64_t)d : 0;
}

/* The elements of an array argument, or the argument itself if it is one number; otherwise none. */
static const struct trace_value *number_or_items(const struct call *c, unsigned i, uint64_t *n)
{
	const struct trace_value *v = arg(c, i);

	if (v->type == TRACE_ARRAY) {
		*n = v->count;
		return v->items;
	}
	*n = v->type != TRACE_NONE && v->type != TRACE_NULL && v->type != TRACE_BLOB && v->type != TRACE_OPAQUE;
	return v;
}

unsigned arg_floats(const struct call *c, unsigned i, float *out, unsigned n)
{
	uint64_t count;
	const struct trace_value *items = number_or_items(c, i, &count);
	unsigned got;

	for (got = 0; got < n && got < count; got++)
		out[got] = items[got].type == TRACE_FLOAT ? items[got].f : (float)gls_value_double(&items[got]);
	return got;
}

unsigned arg_uints(const struct call *c, unsigned i, uint32_t *out, unsigned n)
{
	uint64_t count;
	const struct trace_value *items = number_or_items(c, i, &count);
	unsigned got;

	for (got = 0; got < n && got < count; got++)
		out[got] = (uint32_t)gls_value_int(&items[got]);
	return got;
}

void arg_color(const struct gls_exec *x, const struct call *c, unsigned i, float out[4])
{
	const struct gls_suffix suffix = gls_commands[x->command].suffix;

	memset(out, 0, 4 * sizeof(*out));
	arg_floats(c, i, out, 4);
	for (unsigned k = 0; k < 4 && suffix.type == GLS_SUFFIX_I && suffix.array; k++)
		out[k] = norm_int(out[k]);
}

const struct trace_value *arg_items(const struct call *c, unsigned i, uint64_t *n)
{
	const struct trace_value *v = arg(c, i);

	*n = v->type == TRACE_ARRAY ? v->count : 0;
	return *n ? v->items : NULL;
}

uint32_t arg_next_name(const struct call *c, unsigned i, uint64_t *at)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, i, &n);
	uint32_t name = 0;

	while (!name && *at < n)
		name = (uint32_t)gls_value_int(&names[(*at)++]);
	return name;
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
