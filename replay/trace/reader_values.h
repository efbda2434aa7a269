/* Values of arguments and results. */
#pragma once

#include "replay/trace/reader_sigs.h"

/**
 * Any value.
 * @param a      what it points to goes here
 * @param depth  values it lies in
 */
void reader_value(struct trace_reader *r, struct arena *a, struct trace_value *v, unsigned depth);

/**
 * The quick way. Nearly all that a trace holds are short numbers, known enums and floats within a piece. These
 * functions read them without looking for the piece's end at every byte, and without a store to the reader that the
 * compiler could not keep in a register. Anything else they leave, untouched, to reader_value.
 */
#define READER_QUICK_BYTES 32 /* more than any value without items takes: tag, two numbers and a tag between them */

/** A float at p, behind its tag. @return behind it */
static inline const uint8_t *reader_quick_float(const uint8_t *p, struct trace_value *v)
{
	*v = (struct trace_value){ .type = TRACE_FLOAT };
	memcpy(&v->f, p, sizeof(v->f));
	return p + sizeof(v->f);
}

/** A quick value at p, of which READER_QUICK_BYTES can be read. @return behind it; NULL: not a quick one, v is
 * untouched */
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

/** An array of quick values: the vectors and matrices of GL. As reader_quick_scalar. */
const uint8_t *reader_quick_array(struct trace_reader *r, const uint8_t *p, struct arena *a, struct trace_value *v);
