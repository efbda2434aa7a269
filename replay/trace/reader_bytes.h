/*
 * The internals of a reader, and the data that it reads: numbers, strings and blocks of the unpacked stream.
 *
 * Reading stops at the first failure or at the end: r->status is then set, and every function returns zeros. Callers
 * check it before a loop or an index depends on data that was read.
 */
#pragma once

#include <string.h>

#include "base/arena.h"
#include "capture/format/tags.h"
#include "replay/trace/reader.h"

#define READER_MAX_ARGS 256      /* per call; GL's longest has 17 */
#define READER_MAX_PROPERTIES 64

/* A call that was entered and has not been delivered yet. */
struct reader_call {
	struct call call;
	struct trace_value args[READER_MAX_ARGS];
	struct arena arena;
	int in_use;
};

/* Signatures of one kind, by id. */
struct reader_sigs {
	void **items;
	size_t n;
};

/* A signature that was read, and where it ends in the unpacked stream. */
struct reader_definition {
	enum trace_sig_kind kind;
	uint64_t id, offset;
};

struct trace_reader {
	char *path;
	trace_find *find; /* NULL: no command is known */
	struct container *container;
	const uint8_t *p, *end; /* current piece */
	uint64_t piece_start;   /* offset of the current piece in the unpacked stream */
	const uint8_t *piece;
	int status;             /* 0: reading; 1: end of data; < 0 ERR_* */
	int ended, cut;
	unsigned version;
	uint64_t next_number;

	struct arena sigs; /* signatures and properties */
	struct reader_sigs tables[N_TRACE_SIG_KINDS];
	struct reader_definition *definitions; /* in file order */
	size_t n_definitions, definitions_room;
	const char *properties[READER_MAX_PROPERTIES][2];
	size_t n_properties;

	struct reader_call **pending; /* owned; a pool */
	size_t n_pending;
	struct reader_call *entered;   /* the last one entered, usually the next to return; borrowed */
	struct reader_call *delivered; /* released by the next read */
};

/** Report damage at this place (once). @return r->status */
int reader_fail(struct trace_reader *r, const char *what);

/** As arena_alloc; NULL: out of memory (reported) */
void *reader_alloc(struct trace_reader *r, struct arena *a, size_t n);

/** Get the next piece of the unpacked stream. @return 1, or 0 at its end and after failures */
int reader_refill(struct trace_reader *r);

static inline unsigned reader_byte(struct trace_reader *r)
{
	if (__builtin_expect(r->p == r->end, 0) && !reader_refill(r))
		return 0;
	return *r->p++;
}

/** Read a number of up to 8 bytes; 8 bytes must be readable. @return the position after it; NULL: it is longer */
static inline const uint8_t *reader_quick_uint(const uint8_t *p, uint64_t *value)
{
	uint64_t w, last;

	if (__builtin_expect(*p < 0x80, 1)) {
		*value = *p;
		return p + 1;
	}
	if (p[1] < 0x80) {
		*value = (p[0] & 0x7fu) | (uint64_t)p[1] << 7;
		return p + 2;
	}
	if (p[2] < 0x80) {
		*value = (p[0] & 0x7fu) | (p[1] & 0x7fu) << 7 | (uint64_t)p[2] << 14;
		return p + 3;
	}
	memcpy(&w, p, 8);
	last = ~w & 0x8080808080808080u; /* the top bit of the last byte, and of later bytes */
	if (!last)
		return NULL;
	w &= (last ^ (last - 1)) & 0x7f7f7f7f7f7f7f7fu;
	w = (w & 0x007f007f007f007fu) | (w & 0x7f007f007f007f00u) >> 1; /* groups of 7 bits become groups of 14, 28, 56 */
	w = (w & 0x00003fff00003fffu) | (w & 0x3fff00003fff0000u) >> 2;
	*value = (w & 0x0fffffffu) | (w & 0x0fffffff00000000u) >> 4;
	return p + (__builtin_ctzll(last) >> 3) + 1;
}

/** Read any number. */
uint64_t reader_long_uint(struct trace_reader *r);

/** Read any number. Nearly all take one byte. */
static inline uint64_t reader_uint(struct trace_reader *r)
{
	return __builtin_expect(r->p != r->end && *r->p < 0x80, 1) ? *r->p++ : reader_long_uint(r);
}

void reader_bytes_over_pieces(struct trace_reader *r, uint8_t *to, size_t n);

/** Read n bytes. Inline, so that a number is moved by a single instruction. */
static inline void reader_bytes(struct trace_reader *r, void *out, size_t n)
{
	if (__builtin_expect((size_t)(r->end - r->p) < n, 0)) {
		reader_bytes_over_pieces(r, out, n);
		return;
	}
	memcpy(out, r->p, n);
	r->p += n;
}

/**
 * Read n bytes into an arena, NUL-terminated. The count is not trusted: memory grows with the bytes actually present.
 */
uint8_t *reader_block(struct trace_reader *r, struct arena *a, uint64_t n);

/** Read a string after its length; `count` receives the length unless it is NULL. */
const char *reader_string(struct trace_reader *r, struct arena *a, uint64_t *count);
