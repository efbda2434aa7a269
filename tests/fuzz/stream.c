#include "tests/fuzz/stream.h"

#include <stdlib.h>
#include <string.h>

#include "capture/format/call.h"
#include "tests/fuzz/calls.h"

#define MAX_ID 16384  /* largest signature number read */
#define MAX_SIGS 1024 /* signatures written, per kind */
#define MAX_ENUMS 256 /* enums remembered */
#define MAX_CALLS 4096
#define MAX_NESTING 8

enum kind { CALL, STRUCT, ENUM, BITMASK, N_KINDS };

struct span {
	const uint8_t *at;
	size_t n;
};

/* Definitions in a stream, and its calls: the details of their two events without the terminating byte. */
struct stream {
	struct span sigs[N_KINDS][MAX_ID];
	struct span enums[MAX_ENUMS];
	unsigned n_enums;
	struct stream_call {
		uint64_t thread, sig;
		struct span enter, leave;
	} calls[MAX_CALLS];
	size_t n_calls;
	struct span head;
};

/* The output. */
struct out {
	uint8_t *at, *end;
	int full;
	struct span sigs[N_KINDS][MAX_SIGS]; /* defined so far */
	size_t n_sigs[N_KINDS];
	unsigned *state;
	unsigned before_change; /* values to copy before one is changed */
};

struct cursor {
	const uint8_t *p, *end;
	int failed;
};

/* ---- reading ---- */

static uint64_t get_uint(struct cursor *c)
{
	uint64_t value = 0;

	for (unsigned shift = 0; shift < 64; shift += 7) {
		if (c->p == c->end)
			break;
		value |= (uint64_t)(*c->p & 0x7F) << shift;
		if (*c->p++ < 0x80)
			return value;
	}
	c->failed = 1;
	return 0;
}

static void skip(struct cursor *c, uint64_t n)
{
	if (n > (uint64_t)(c->end - c->p))
		c->failed = 1;
	else if (n)
		c->p += n;
}

static void skip_text(struct cursor *c)
{
	skip(c, get_uint(c));
}

/* Skip the definition of a signature. */
static void skip_definition(struct cursor *c, enum kind kind)
{
	uint64_t n;

	if (kind == CALL || kind == STRUCT)
		skip_text(c);
	n = get_uint(c);
	for (uint64_t i = 0; i < n && !c->failed; i++) {
		skip_text(c);
		if (kind == ENUM)
			skip(c, 1);
		if (kind == ENUM || kind == BITMASK)
			get_uint(c);
	}
}

/* The number of members of a struct. */
static uint64_t members_of(struct span definition)
{
	struct cursor c = { definition.at, definition.at ? definition.at + definition.n : NULL, 0 };

	skip_text(&c);
	return get_uint(&c);
}

/* ---- writing ---- */

static void put(struct out *o, const void *bytes, size_t n)
{
	if (!o || o->full)
		return;
	if (n > (size_t)(o->end - o->at)) {
		o->full = 1;
		return;
	}
	memcpy(o->at, bytes, n);
	o->at += n;
}

static void put_byte(struct out *o, unsigned byte)
{
	put(o, &(uint8_t){ (uint8_t)byte }, 1);
}

static void put_uint(struct out *o, uint64_t value)
{
	for (; value >= 0x80; value >>= 7)
		put_byte(o, (unsigned)value | 0x80);
	put_byte(o, (unsigned)value);
}

/* Write a signature's number, with its definition if that has not been written yet. */
static void put_sig(struct out *o, enum kind kind, struct span sig)
{
	size_t i = 0;

	if (!o)
		return;
	while (i < o->n_sigs[kind] && (o->sigs[kind][i].n != sig.n || memcmp(o->sigs[kind][i].at, sig.at, sig.n) != 0))
		i++;
	if (i == MAX_SIGS) {
		o->full = 1;
		return;
	}
	put_uint(o, i);
	if (i < o->n_sigs[kind])
		return;
	o->sigs[kind][o->n_sigs[kind]++] = sig;
	put(o, sig.at, sig.n);
}

/* ---- values ---- */

/* Read a signature's number, with its definition if it follows, and write it. */
static struct span copy_sig(struct stream *s, struct cursor *c, struct out *o, enum kind kind)
{
	uint64_t id = get_uint(c);
	struct span *sig = &s->sigs[kind][id < MAX_ID ? id : 0];

	if (id >= MAX_ID || c->failed) {
		c->failed = 1;
		return (struct span){ 0 };
	}
	if (!sig->at || sig->at == c->p) {
		sig->at = c->p;
		skip_definition(c, kind);
		sig->n = (size_t)(c->p - sig->at);
		if (kind == ENUM && !o && !c->failed && s->n_enums < MAX_ENUMS)
			s->enums[s->n_enums++] = *sig;
	}
	if (!c->failed)
		put_sig(o, kind, *sig);
	return *sig;
}

static void put_random_bytes(struct out *o)
{
	static const unsigned SIZES[] = { 0, 1, 3, 16, 64, 256, 1024, 4096 };
	unsigned n = SIZES[calls_draw(o->state, 8)], what = calls_draw(o->state, 512);

	put_uint(o, n);
	while (n--)
		put_byte(o, what < 256 ? what : calls_draw(o->state, 256));
}

/* Any value in place of another, usually one of the same type. */
static void put_other(struct out *o, unsigned tag, const struct stream *s)
{
	static const uint64_t NUMBERS[] = { 0,       1,          2,          3,          7,
		                            255,     256,        4096,       0x7FFF,     0xFFFF,
		                            0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, UINT64_MAX };
	static const float FLOATS[] = { 0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 1e-40f, 3.4e38f, 1e9f, (float)0x1p31, -1e20f };
	uint64_t number = calls_draw(o->state, 2) ? calls_draw(o->state, 64) :
	                                            NUMBERS[calls_draw(o->state, sizeof(NUMBERS) / sizeof(NUMBERS[0]))];
	const struct calls_group *tokens = &calls_groups[0];
	struct span sig = s->enums[calls_draw(o->state, s->n_enums)];
	struct cursor c = { sig.at, sig.at ? sig.at + sig.n : NULL, 0 };
	float f = calls_draw(o->state, 2) ? FLOATS[calls_draw(o->state, 10)] :
	                                    ((int)calls_draw(o->state, 2000) - 1000) / 64.0f;
	double d = f;

	if (calls_draw(o->state, 16) == 0)
		tag = calls_draw(o->state, TRACE_OPAQUE + 1);
	put_byte(o, tag == TRACE_ENUM || tag == TRACE_BITMASK || tag == TRACE_ARRAY || tag == TRACE_STRUCT ? TRACE_UINT : tag);
	if (tag == TRACE_FLOAT)
		put(o, &f, 4);
	else if (tag == TRACE_DOUBLE)
		put(o, &d, 8);
	else if (tag == TRACE_STRING || tag == TRACE_BLOB)
		put_random_bytes(o);
	else if (tag == TRACE_ENUM && sig.at && get_uint(&c) == 1) { /* one defined in the stream */
		skip_text(&c);
		skip(&c, 1);
		put_uint(o, get_uint(&c));
	} else if (tag == TRACE_ENUM)
		put_uint(o, tokens->values[calls_draw(o->state, tokens->n)]);
	else if (tag > TRACE_TRUE)
		put_uint(o, number);
}

/* Read a value and write it (o NULL: only read it), or write another one. */
static void copy_value(struct stream *s, struct cursor *c, struct out *o, unsigned depth)
{
	const uint8_t *from = c->p;
	unsigned tag = c->p < c->end ? *c->p : N_TRACE_TYPES;
	uint64_t n = 1;

	if (o && o->before_change-- == 0) {
		put_other(o, tag, s);
		o = NULL;
	}
	put_byte(o, tag);
	skip(c, 1);
	if (depth > MAX_NESTING || tag >= N_TRACE_TYPES)
		c->failed = 1;
	if (tag == TRACE_ENUM || tag == TRACE_BITMASK) {
		copy_sig(s, c, o, tag == TRACE_ENUM ? ENUM : BITMASK);
		from = c->p;
		if (tag == TRACE_ENUM)
			skip(c, 1);
		get_uint(c);
	} else if (tag == TRACE_ARRAY || tag == TRACE_STRUCT || tag == TRACE_REPR) {
		n = tag == TRACE_STRUCT ? members_of(copy_sig(s, c, o, STRUCT)) : tag == TRACE_ARRAY ? get_uint(c) : 2;
		if (tag == TRACE_ARRAY)
			put_uint(o, n);
		for (uint64_t i = 0; i < n && !c->failed; i++)
			copy_value(s, c, o, depth + 1);
		return;
	} else {
		from++;
		if (tag == TRACE_FLOAT || tag == TRACE_DOUBLE)
			skip(c, tag == TRACE_FLOAT ? 4 : 8);
		else if (tag == TRACE_STRING || tag == TRACE_BLOB)
			skip_text(c);
		else if (tag == TRACE_WSTRING)
			for (n = get_uint(c); n && !c->failed; n--)
				get_uint(c);
		else if (tag > TRACE_TRUE)
			get_uint(c);
	}
	if (!c->failed)
		put(o, from, (size_t)(c->p - from));
}

/* Copy the details of an event, and read the terminating byte without writing it. */
static void copy_details(struct stream *s, struct cursor *c, struct out *o)
{
	while (!c->failed) {
		unsigned detail = c->p < c->end ? *c->p : 0;
		skip(c, 1);
		if (detail == 0)
			return;
		put_byte(o, detail);
		if (detail == 1 || detail == 5)
			put_uint(o, get_uint(c));
		if (detail == 1 || detail == 2)
			copy_value(s, c, o, 0);
		else if (detail != 5)
			c->failed = 1;
	}
}

/* ---- streams ---- */

static struct span details(struct stream *s, struct cursor *c)
{
	const uint8_t *from = c->p;

	copy_details(s, c, NULL);
	return (struct span){ from, (size_t)(c->p - from) };
}

/* Parse the complete part of a stream. @return 0: there is none */
static int take_apart(struct stream *s, const uint8_t *data, size_t size)
{
	struct cursor c = { data, data, 0 };
	uint64_t number;

	memset(s, 0, sizeof(*s));
	if (size)
		c.end += size;
	if (get_uint(&c) != 6 || get_uint(&c) != 6)
		return 0;
	while (c.p < c.end && *c.p != 0 && !c.failed) {
		skip_text(&c);
		skip_text(&c);
	}
	skip(&c, 1);
	s->head = (struct span){ data, (size_t)(c.p - data) };
	while (!c.failed && c.p < c.end && s->n_calls < MAX_CALLS) {
		struct stream_call *call = &s->calls[s->n_calls];
		const uint8_t *from;
		if (*c.p++ == 0) {
			call->thread = get_uint(&c);
			from = c.p;
			call->sig = get_uint(&c);
			c.p = from;
			copy_sig(s, &c, NULL, CALL);
			call->enter = details(s, &c);
			s->n_calls += !c.failed;
		} else {
			number = get_uint(&c);
			if (number >= s->n_calls || c.failed)
				break;
			s->calls[number].leave = details(s, &c);
			if (c.failed)
				s->calls[number].leave = (struct span){ 0 };
		}
	}
	return s->n_calls > 0;
}

static void copy_call(struct stream *s, const struct stream_call *call, struct span sig, uint64_t number, struct out *o)
{
	struct cursor c = { call->enter.at, call->enter.at + call->enter.n, 0 };

	put_byte(o, 0);
	put_uint(o, call->thread);
	put_sig(o, CALL, sig);
	copy_details(s, &c, o);
	put_byte(o, 0);
	if (!call->leave.at)
		return;
	c = (struct cursor){ call->leave.at, call->leave.at + call->leave.n, 0 };
	put_byte(o, 1);
	put_uint(o, number);
	copy_details(s, &c, o);
	put_byte(o, 0);
}

/* A call to be written. */
struct place {
	struct stream *from;
	size_t call, name; /* name: the call whose signature it uses */
	int changed;
};

/* Apply one change to n places (at most MAX_CALLS). @return the new number of places */
static size_t change_order(struct place *places, size_t n, struct stream *a, struct stream *b, unsigned *state)
{
	size_t at = calls_draw(state, (unsigned)n), to = calls_draw(state, (unsigned)n + 1), most = n - at, count;
	struct stream *from = b && calls_draw(state, 2) ? b : a;
	struct place moved[16];

	count = 1 + calls_draw(state, most < 16 ? (unsigned)most : 16);
	switch (n ? calls_draw(state, 7) : 6) {
	case 0: /* omitted */
		memmove(places + at, places + at + count, (n - at - count) * sizeof(*places));
		return n - count;
	case 1: /* swapped names */
		places[at].name = calls_draw(state, (unsigned)places[at].from->n_calls);
		return n;
	case 2:
	case 3:
	case 4: /* different values */
		for (size_t i = 0; i < 1 + count / 4; i++)
			places[calls_draw(state, (unsigned)n)].changed = 1;
		return n;
	case 5: /* repeat some existing calls */
		memcpy(moved, places + at, count * sizeof(*places));
		break;
	default: /* part of a stream */
		at = calls_draw(state, (unsigned)from->n_calls);
		count = count < from->n_calls - at ? count : from->n_calls - at;
		for (size_t i = 0; i < count; i++)
			moved[i] = (struct place){ from, at + i, at + i, 0 };
	}
	if (n + count > MAX_CALLS)
		return n;
	memmove(places + to + count, places + to, (n - to) * sizeof(*places));
	memcpy(places + to, moved, count * sizeof(*places));
	return n + count;
}

size_t stream_change(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t room,
                     unsigned *state)
{
	static struct stream one, other;
	static struct place places[MAX_CALLS];
	static struct out o;
	uint64_t number = 0;
	size_t n;

	if (!take_apart(&one, a, a_size))
		return 0;
	if (b && !take_apart(&other, b, b_size))
		b = NULL;
	o = (struct out){ .at = out, .end = out + room, .state = state };
	n = one.n_calls;
	for (size_t i = 0; i < n; i++)
		places[i] = (struct place){ &one, i, i, 0 };
	for (unsigned i = 1 + calls_draw(state, 4); i; i--)
		n = change_order(places, n, &one, b ? &other : NULL, state);
	put(&o, one.head.at, one.head.n);
	for (size_t i = 0; i < n && !o.full; i++) {
		struct stream *s = places[i].from;
		uint8_t *whole = o.at;
		o.before_change = places[i].changed ? calls_draw(state, 12) : UINT32_MAX;
		copy_call(s, &s->calls[places[i].call], s->sigs[CALL][s->calls[places[i].name].sig], number++, &o);
		if (o.full)
			o.at = whole;
	}
	return (size_t)(o.at - out);
}
