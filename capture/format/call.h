/*
 * One recorded call: what the trace holds, in memory. The grammar of the file is in trace.md.
 *
 * A call owns nothing: its name and signature live as long as the reader, its values until the next call is read.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/tags.h"

struct trace_value {
	enum trace_type type;
	const void *sig; /* ENUM, BITMASK, STRUCT: the reader's signature (names), else NULL */
	uint64_t count;  /* STRING, BLOB: bytes; ARRAY, STRUCT, WSTRING: elements; REPR: 2 */
	union {
		uint64_t u;  /* UINT, BITMASK, OPAQUE */
		int64_t i;   /* SINT, ENUM */
		float f;
		double d;
		const char *str;                  /* STRING: NUL-terminated beyond its count */
		const uint8_t *blob;
		const struct trace_value *items;  /* ARRAY, STRUCT members, REPR (human, machine) */
		const uint32_t *wide;
	};
};

struct call_sig {
	uint64_t id;
	const char *name;
	uint32_t n_args;
	const char **arg_names;
	int32_t command; /* index in the generated command table, -1: unknown there */
};

/* Names of the lists that our recorder makes of runs from Begin to End, from the first one down (trace.md). */
enum { CALL_RUN_FIRST = 0xFFFFFF, CALL_RUN_LAST = 0xF00000 };

struct call {
	uint64_t number; /* ordinal of its ENTER event, from 0 */
	uint64_t thread;
	const struct call_sig *sig;
	uint32_t flags;  /* CALL_FAKE */
	int incomplete;  /* the file ended before the call returned */
	uint32_t n_args; /* at least sig->n_args; unrecorded ones are TRACE_NONE */
	const struct trace_value *args;
	struct trace_value ret; /* TRACE_NONE for void calls */
};
