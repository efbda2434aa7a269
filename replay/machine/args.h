/* Arguments of a call, converted to the type that a handler wants. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/call.h"

struct gls_exec;

/** The value, if it is a number, enum, boolean, mask or pointer, converted to the return type; otherwise 0. */
double gls_value_double(const struct trace_value *v);
int64_t gls_value_truncated(const struct trace_value *v);
static inline int64_t gls_value_int(const struct trace_value *v)
{
	const uint32_t whole = 1u << TRACE_SINT | 1u << TRACE_UINT | 1u << TRACE_ENUM | 1u << TRACE_BITMASK |
	                       1u << TRACE_OPAQUE;

	return whole >> ((uint32_t)v->type & 31) & 1 ? v->i : gls_value_truncated(v);
}

extern const struct trace_value gls_no_value; /* used for a missing argument */

static inline const struct trace_value *arg(const struct call *c, unsigned i)
{
	return i < c->n_args ? &c->args[i] : &gls_no_value;
}
static inline float arg_f(const struct call *c, unsigned i)
{
	const struct trace_value *v = arg(c, i);
	return v->type == TRACE_FLOAT ? v->f : (float)gls_value_double(v);
}
/** A token or index that was passed as a float; 0 if out of range. */
static inline uint32_t token_of_float(float v)
{
	return v >= 0.0f && v < 4294967296.0f ? (uint32_t)v : 0;
}
static inline double arg_d(const struct call *c, unsigned i)
{
	return gls_value_double(arg(c, i));
}
/** A number, clamped to [0,1] as GL requires. */
static inline float arg_clamped(const struct call *c, unsigned i)
{
	double v = arg_d(c, i);
	return (float)(v < 0 ? 0 : v > 1 ? 1 : v);
}
static inline int64_t arg_i(const struct call *c, unsigned i)
{
	return gls_value_int(arg(c, i));
}
static inline uint32_t arg_u(const struct call *c, unsigned i)
{
	return (uint32_t)gls_value_int(arg(c, i));
}
/** A GLint for arithmetic: truncated to 32 bits, whatever the recording holds, so that sums fit in 64. */
static inline int64_t arg_i32(const struct call *c, unsigned i)
{
	return (int32_t)gls_value_int(arg(c, i));
}
/**
 * Read numbers from an array argument, or one plain number. @return how many were read; the rest of out is unchanged
 */
unsigned arg_floats(const struct call *c, unsigned i, float *out, unsigned n);
unsigned arg_uints(const struct call *c, unsigned i, uint32_t *out, unsigned n);
/**
 * A colour of four numbers; missing ones are 0. Integers of a command ending in -iv are mapped to [-1,1] (GL 2.1 table
 * 2.9).
 */
void arg_color(const struct gls_exec *x, const struct call *c, unsigned i, float out[4]);
/** Elements of an array argument; NULL and 0 if it is not an array. */
const struct trace_value *arg_items(const struct call *c, unsigned i, uint64_t *n);
/**
 * Iterate over the object names in an array argument, skipping 0. *at is the position; start with 0. @return a name; 0:
 * no more
 */
uint32_t arg_next_name(const struct call *c, unsigned i, uint64_t *at);
/** Bytes of a blob argument; NULL if it is not a blob. */
const uint8_t *arg_blob(const struct call *c, unsigned i, size_t *n);
/** 1 if the argument is an address or NULL: an offset in a buffer object. */
int arg_is_offset(const struct call *c, unsigned i);
