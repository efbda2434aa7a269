/* Values of arguments and results. */
#pragma once

#include "replay/trace/reader_sigs.h"

/**
 * Read any value.
 * @param a      memory for data that it points to
 * @param depth  nesting depth
 */
void reader_value(struct trace_reader *r, struct arena *a, struct trace_value *v, unsigned depth);

/**
 * The fast path. Nearly all data in a trace is short numbers, known enums and floats within one piece. These functions
 * read such values without checking for the piece's end at every byte, and without stores to the reader that keep the
 * compiler from using registers. They leave anything else, unread, to reader_value.
 */
#define READER_QUICK_BYTES 32 /* more than any value without items takes: a tag, and two numbers with a tag between
                                 them */

/** Read a float at p, after its tag. @return the position after it */
static inline const uint8_t *reader_quick_float(const uint8_t *p, struct trace_value *v)
{
	*v = (struct trace_value){ .type = TRACE_FLOAT };
	memcpy(&v->f, p, sizeof(v->f));
	return p + sizeof(v->f);
}

/**
 * Read a simple value at p; READER_QUICK_BYTES must be readable. @return the position after it; NULL: not a simple one,
 * v is unchanged
 */
static inline const uint8_t *reader_quick_scalar(const struct trace_reader *r, const uint8_t *p, struct trace_value *v)
{
	unsigned tag = *p++, sign;
	const void *sig = NULL;
	uint64_t bits = 0;

	switch (tag) {
	case TRACE_NULL:
	case TRACE_FALSE:
		break;
	case TRACE_TRUE:
		bits = 1;
		break;
	case TRACE_FLOAT:
		return reader_quick_float(p, v);
	case TRACE_DOUBLE:
		*v = (struct trace_value){ .type = TRACE_DOUBLE };
		memcpy(&v->d, p, 8);
		return p + 8;
	case TRACE_SINT:
		p = reader_quick_uint(p, &bits);
		bits = -bits;
		break;
	case TRACE_UINT:
	case TRACE_OPAQUE:
		p = reader_quick_uint(p, &bits);
		break;
	case TRACE_ENUM:
		p = reader_quick_uint(p, &bits);
		sig = p ? reader_known_sig(r, TRACE_SIG_ENUM, bits) : NULL;
		if (!sig || r->version < 3)
			return NULL;
		sign = *p++;
		if (sign != TRACE_SINT && sign != TRACE_UINT)
			return NULL;
		p = reader_quick_uint(p, &bits);
		bits = sign == TRACE_SINT ? -bits : bits;
		break;
	case TRACE_BITMASK:
		p = reader_quick_uint(p, &bits);
		sig = p ? reader_known_sig(r, TRACE_SIG_BITMASK, bits) : NULL;
		if (!sig)
			return NULL;
		p = reader_quick_uint(p, &bits);
		break;
	default:
		return NULL;
	}
	if (p)
		*v = (struct trace_value){ .type = (enum trace_type)tag, .sig = sig, .u = bits };
	return p;
}

/** Read an array of simple values, such as GL's vectors and matrices. As reader_quick_scalar. */
const uint8_t *reader_quick_array(struct trace_reader *r, const uint8_t *p, struct arena *a, struct trace_value *v);
