/*
 * Runs inside the traced program. Values in the trace (trace.md): each put_* function writes one at the position `p`
 * and returns the position after it. At least RECORDING_MARGIN bytes are free there, enough for any scalar arguments.
 * Call them between begin and end of a call (writer.h). Every function keeps errno; none allocates.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "capture/format/tags.h"
#include "capture/write/recording.h"
#include "capture/write/tables.h"

/* Bulk values: they may hand chunks to the file on the way. A negative count is 0; a NULL pointer is written as
 * null. */

/** Text; `bytes` < 0: up to its NUL. */
uint8_t *put_string(uint8_t *p, const char *s, long bytes);
/** Text in a buffer of `size` bytes that may lack a NUL. */
uint8_t *put_text(uint8_t *p, const char *s, long size);
/** Raw memory, read without ever faulting: unreadable bytes become zeros (pages.h). */
uint8_t *put_blob(uint8_t *p, const void *data, long bytes);
/** Raw memory of the recorder's own. */
uint8_t *put_own_blob(uint8_t *p, const void *data, long bytes);
/** `count` texts; `lengths` may be NULL, and an entry below 0 means up to the NUL. */
uint8_t *put_strings(uint8_t *p, const char *const *strings, long count, const int *lengths);
/** An XVisualInfo. */
uint8_t *put_visual(uint8_t *p, const void *visual);
/** Pairs of a list up to the value `end`. */
uint8_t *put_attribs(uint8_t *p, const int *list, int end);
uint8_t *put_attribs_wide(uint8_t *p, const long *list, long end);

/**
 * Arrays of values; NULL becomes null. More than 16 values are read without faulting. More than 256 are written as none
 * if their end cannot be read.
 */
uint8_t *put_array_s8(uint8_t *p, const int8_t *v, long n);
uint8_t *put_array_u8(uint8_t *p, const uint8_t *v, long n);
uint8_t *put_array_s16(uint8_t *p, const int16_t *v, long n);
uint8_t *put_array_u16(uint8_t *p, const uint16_t *v, long n);
uint8_t *put_array_s32(uint8_t *p, const int32_t *v, long n);
uint8_t *put_array_u32(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_s64(uint8_t *p, const int64_t *v, long n);
uint8_t *put_array_u64(uint8_t *p, const uint64_t *v, long n);
#define put_array_slong(p, v, n) (sizeof(long) == 8 ? put_array_s64(p, v, n) : put_array_s32(p, v, n))
#define put_array_ulong(p, v, n) (sizeof(long) == 8 ? put_array_u64(p, v, n) : put_array_u32(p, v, n))
uint8_t *put_array_f32(uint8_t *p, const float *v, long n);
uint8_t *put_array_f64(uint8_t *p, const double *v, long n);
uint8_t *put_array_enum(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_bool8(uint8_t *p, const uint8_t *v, long n);
uint8_t *put_array_bool32(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_ptr(uint8_t *p, const void *const *v, long n);
/** An array of `n` zeros, for memory at `data` that GL fills later. */
uint8_t *put_zeros(uint8_t *p, const void *data, long n);
/** The head of an array of `n` values that the caller puts, with put_room after every few. */
uint8_t *put_array_head(uint8_t *p, long n);
/** Raw bytes without a tag; `data` is read without faulting. */
uint8_t *put_memory(uint8_t *p, const void *data, size_t bytes);

/* Scalars. Only functions that every call needs are inline: there are thousands of thunks. */

/** `index` < 128. */
static inline uint8_t *put_argument(uint8_t *p, unsigned index)
{
	p[0] = TRACE_DETAIL_ARGUMENT;
	p[1] = (uint8_t)index;
	return p + 2;
}

static inline uint8_t *put_return(uint8_t *p)
{
	*p++ = TRACE_DETAIL_RESULT;
	return p;
}

static inline uint8_t *put_null(uint8_t *p)
{
	*p++ = TRACE_NULL;
	return p;
}

static inline uint8_t *put_float(uint8_t *p, float v)
{
	*p++ = TRACE_FLOAT;
	memcpy(p, &v, sizeof(v));
	return p + sizeof(v);
}

static inline uint8_t *put_double(uint8_t *p, double v)
{
	*p++ = TRACE_DOUBLE;
	memcpy(p, &v, sizeof(v));
	return p + sizeof(v);
}

static inline uint8_t *put_varint(uint8_t *p, uint64_t v)
{
	while (v >= 0x80) {
		*p++ = (uint8_t)(v | 0x80);
		v >>= 7;
	}
	*p++ = (uint8_t)v;
	return p;
}

uint8_t *put_uint(uint8_t *p, uint64_t v);
uint8_t *put_sint(uint8_t *p, int64_t v);
uint8_t *put_address(uint8_t *p, uintptr_t v);
#define put_opaque(p, v) put_address(p, (uintptr_t)(v))
/** An enumerant; a plain number if it has no name. */
uint8_t *put_enum(uint8_t *p, uint32_t v);
/** An enumerant of a group that names small values in its own way. */
uint8_t *put_enum_small(uint8_t *p, uint32_t v, const uint16_t group[16]);
/** A number that may be an enumerant in a numeric parameter; small values are taken for numbers. */
uint8_t *put_symbol(uint8_t *p, int64_t v);
uint8_t *put_bits(uint8_t *p, uint32_t v, const struct bits_entry *bits);
/** Truth: the enumerants GL_FALSE and GL_TRUE in GL, a plain truth value in GLX and EGL. */
uint8_t *put_bool8(uint8_t *p, unsigned v);
uint8_t *put_bool32(uint8_t *p, unsigned v);

/** A text of the recorder's own, without a tag. It fits into the margin. */
uint8_t *put_chars(uint8_t *p, const char *s);

/** In the child of a fork: the new trace has no signatures yet. */
void values_forget(void);
