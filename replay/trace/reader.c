/* The grammar is in capture/format/trace.md; section numbers of the format's notes are not repeated here. */
#include "replay/trace/reader.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/arena.h"
#include "base/bytes.h"
#include "replay/trace/container.h"
#include "replay/machine/commands.h"

#define FORMAT_NEWEST 6
#define MAX_DEPTH 16           /* arrays in structs in arrays; recorders need 3 */
#define MAX_ARGS 256           /* of a call; GL's longest has 17 */
#define MAX_ID (1u << 20)      /* of signatures */
#define MAX_PENDING 1024       /* calls that have not returned */
#define MAX_PROPERTIES 64
#define ARENA_KEEP (64u << 20) /* a call's memory that is kept for the next one */

struct pending {
	struct call call;
	struct trace_value args[MAX_ARGS];
	struct arena arena;
	int in_use;
};

/* Signatures of one kind by id. */
struct sig_table {
	void **items;
	size_t n;
};

enum sig_kind { SIG_CALL, SIG_STRUCT, SIG_ENUM, SIG_BITMASK, SIG_FRAME, N_SIG_KINDS };

/* A signature was defined: which, and how far into the unpacked stream. */
struct definition {
	enum sig_kind kind;
	uint64_t id, offset;
};

struct trace_reader {
	char *path;
	struct container *container;
	const uint8_t *p, *end; /* the piece being read */
	uint64_t piece_start;   /* logical offset of the piece's first byte */
	const uint8_t *piece;
	int status;             /* 0: going; 1: the bytes ended; < 0 ERR_* */
	int ended, cut;
	unsigned version;
	uint64_t next_number;

	struct arena sigs; /* signatures and properties */
	struct sig_table tables[N_SIG_KINDS];
	struct definition *definitions; /* in the order of the file */
	size_t n_definitions, definitions_room;
	const char *properties[MAX_PROPERTIES][2];
	size_t n_properties;

	struct pending **pending; /* owned; a pool */
	size_t n_pending;
	struct pending *entered;   /* the last one, most often the next to return; borrowed */
	struct pending *delivered; /* freed by the next read */
	struct arena scratch;      /* of calls that are parsed and dropped */
};

static int fail_at(struct trace_reader *r, const char *what)
{
	if (r->status == 0)
		r->status = err_report(ERR_INPUT, r->path,
		                       "damaged in call %llu, byte %llu of the file (%llu unpacked): %s; the calls before it can "
		                       "be used",
		                       (unsigned long long)r->next_number, (unsigned long long)container_offset(r->container),
		                       (unsigned long long)(r->piece_start + (uint64_t)(r->p - r->piece)), what);
	return r->status;
}

static void *take(struct trace_reader *r, struct arena *a, size_t n)
{
	void *out = arena_alloc(a, n);

	if (!out && r->status == 0)
		r->status = err_report(ERR_SYSTEM, r->path, "out of memory for %zu bytes of one call", n);
	return out;
}

/* ---- bytes ---- */

static int refill(struct trace_reader *r)
{
	size_t n;
	int rc;

	if (r->status)
		return 0;
	r->piece_start += (uint64_t)(r->end - r->piece);
	rc = container_next(r->container, &r->piece, &n);
	if (rc != 1) {
		r->status = rc < 0 ? rc : 1;
		r->piece = r->p = r->end = NULL;
		return 0;
	}
	r->p = r->piece;
	r->end = r->piece + n;
	return 1;
}

static inline unsigned read_byte(struct trace_reader *r)
{
	if (__builtin_expect(r->p == r->end, 0) && !refill(r))
		return 0;
	return *r->p++;
}

/* A number of up to 8 bytes, of which 8 can be read. @return behind it; NULL: it is longer */
static inline const uint8_t *quick_uint(const uint8_t *p, uint64_t *value)
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
	last = ~w & 0x8080808080808080u; /* the top bit of the last byte, and others above it */
	if (!last)
		return NULL;
	w &= (last ^ (last - 1)) & 0x7f7f7f7f7f7f7f7fu;
	w = (w & 0x007f007f007f007fu) | (w & 0x7f007f007f007f00u) >> 1; /* groups of 7 bits become 14, 28, 56 */
	w = (w & 0x00003fff00003fffu) | (w & 0x3fff00003fff0000u) >> 2;
	*value = (w & 0x0fffffffu) | (w & 0x0fffffff00000000u) >> 4;
	return p + (__builtin_ctzll(last) >> 3) + 1;
}

static uint64_t read_long_uint(struct trace_reader *r)
{
	uint64_t value = 0;
	unsigned shift = 0, byte;

	if (__builtin_expect(r->end - r->p >= 8, 1)) {
		const uint8_t *behind = quick_uint(r->p, &value);

		if (behind) {
			r->p = behind;
			return value;
		}
		value = 0;
	}
	do {
		byte = read_byte(r);
		if (shift == 63 && byte > 1) {
			fail_at(r, "a number of more than 64 bits");
			return 0;
		}
		value |= (uint64_t)(byte & 0x7f) << shift;
		shift += 7;
	} while (byte & 0x80);
	return value;
}

/* Nearly all numbers are of one byte. */
static inline uint64_t read_uint(struct trace_reader *r)
{
	return __builtin_expect(r->p != r->end && *r->p < 0x80, 1) ? *r->p++ : read_long_uint(r);
}

static void read_bytes_over_pieces(struct trace_reader *r, uint8_t *to, size_t n)
{
	while (n) {
		size_t here = (size_t)(r->end - r->p);
		if (here == 0) {
			if (!refill(r))
				return;
			continue;
		}
		if (here > n)
			here = n;
		memcpy(to, r->p, here);
		r->p += here;
		to += here;
		n -= here;
	}
}

/* Inline, so that a number's bytes are moved by an instruction. */
static inline void read_bytes(struct trace_reader *r, void *out, size_t n)
{
	if (__builtin_expect((size_t)(r->end - r->p) < n, 0)) {
		read_bytes_over_pieces(r, out, n);
		return;
	}
	memcpy(out, r->p, n);
	r->p += n;
}

/*
 * n bytes into an arena, NUL-terminated. The count is not believed: room grows with the bytes that are really there.
 */
static uint8_t *read_block(struct trace_reader *r, struct arena *a, uint64_t n)
{
	size_t room = n < (4u << 20) ? (size_t)n : 4u << 20, got = 0;
	uint8_t *out;

	if (n > (uint64_t)1 << 40) {
		fail_at(r, "a string or blob of impossible size");
		return NULL;
	}
	out = take(r, a, room + 1);
	while (out && r->status == 0) {
		read_bytes(r, out + got, room - got);
		got = room;
		if (room == n)
			break;
		room = n - room < room ? (size_t)n : 2 * room;
		uint8_t *grown = take(r, a, room + 1);
		if (grown)
			memcpy(grown, out, got);
		out = grown;
	}
	if (!out || r->status)
		return NULL;
	out[n] = 0;
	return out;
}

static const char *read_string(struct trace_reader *r, struct arena *a, uint64_t *count)
{
	uint64_t n = read_uint(r);

	if (r->status)
		return NULL;
	if (count)
		*count = n;
	return (const char *)read_block(r, a, n);
}

/* ---- signatures ---- */

/* The slot of an id, or NULL (failed). An empty slot: the signature follows. */
static void **slot_of(struct trace_reader *r, enum sig_kind kind, uint64_t id)
{
	struct sig_table *t = &r->tables[kind];

	if (r->status)
		return NULL;
	if (id >= MAX_ID) {
		fail_at(r, "a signature's number is out of all measure");
		return NULL;
	}
	if (id >= t->n) {
		size_t n = t->n ? t->n : 64;
		while (n <= id)
			n *= 2;
		void **grown = realloc(t->items, n * sizeof(*grown));
		if (!grown) {
			r->status = err_report(ERR_SYSTEM, r->path, "out of memory");
			return NULL;
		}
		memset(grown + t->n, 0, (n - t->n) * sizeof(*grown));
		t->items = grown;
		t->n = n;
	}
	return &t->items[id];
}

/* A signature is whole: note where it ends, so that one knows before which places of the file it stands. */
static void define(struct trace_reader *r, enum sig_kind kind, uint64_t id, void *sig)
{
	if (MEMORY_GROW(r->definitions, r->definitions_room, r->n_definitions + 1)) {
		r->status = ERR_SYSTEM;
		return;
	}
	r->definitions[r->n_definitions++] =
		(struct definition){ kind, id, r->piece_start + (uint64_t)(r->p - r->piece) };
	r->tables[kind].items[id] = sig;
}

static const char **read_names(struct trace_reader *r, uint64_t n)
{
	const char **names;

	if (n > 65536) {
		fail_at(r, "a signature with too many names");
		return NULL;
	}
	names = take(r, &r->sigs, (n + 1) * sizeof(*names));
	for (uint64_t i = 0; names && i < n; i++)
		if (!(names[i] = read_string(r, &r->sigs, NULL)))
			return NULL;
	return names;
}

static int64_t read_tagged_int(struct trace_reader *r)
{
	unsigned tag = read_byte(r);
	uint64_t value;

	if (tag != TRACE_SINT && tag != TRACE_UINT) {
		if (r->status == 0)
			fail_at(r, "an enum's value is no number");
		return 0;
	}
	value = read_uint(r);
	return tag == TRACE_SINT ? (int64_t)-value : (int64_t)value;
}

/* A signature that was met before, or NULL. */
static inline void *known_sig(const struct trace_reader *r, enum sig_kind kind, uint64_t id)
{
	const struct sig_table *t = &r->tables[kind];

	return __builtin_expect(id < t->n && r->status == 0, 1) ? t->items[id] : NULL;
}

static const struct call_sig *read_call_sig(struct trace_reader *r)
{
	uint64_t id = read_uint(r), n;
	struct call_sig *sig = known_sig(r, SIG_CALL, id);
	void **slot;

	if (sig)
		return sig;
	slot = slot_of(r, SIG_CALL, id);
	if (!slot || *slot)
		return slot ? *slot : NULL;
	sig = take(r, &r->sigs, sizeof(*sig));
	if (!sig)
		return NULL;
	sig->id = id;
	sig->name = read_string(r, &r->sigs, NULL);
	n = read_uint(r);
	if (!sig->name || r->status)
		return NULL;
	if (n > MAX_ARGS) {
		fail_at(r, "a call with too many arguments");
		return NULL;
	}
	sig->n_args = (uint32_t)n;
	sig->arg_names = read_names(r, n);
	if (!sig->arg_names)
		return NULL;
	sig->command = gls_command_find(sig->name);
	define(r, SIG_CALL, id, sig);
	return sig;
}

static const struct trace_enum_sig *read_enum_sig(struct trace_reader *r)
{
	uint64_t id = read_uint(r);
	struct trace_enum_sig *sig = known_sig(r, SIG_ENUM, id);
	void **slot;
	uint64_t n;

	if (sig)
		return sig;
	slot = slot_of(r, SIG_ENUM, id);
	if (!slot || *slot)
		return slot ? *slot : NULL;
	n = r->version >= 3 ? read_uint(r) : 1;
	if (n > 65536)
		fail_at(r, "an enum with too many names");
	if (r->status)
		return NULL;
	sig = take(r, &r->sigs, sizeof(*sig));
	if (!sig || !(sig->names = take(r, &r->sigs, (n + 1) * sizeof(*sig->names))) ||
	    !(sig->values = take(r, &r->sigs, (n + 1) * sizeof(*sig->values))))
		return NULL;
	sig->n = (uint32_t)n;
	for (uint64_t i = 0; i < n; i++) {
		if (!(sig->names[i] = read_string(r, &r->sigs, NULL)))
			return NULL;
		sig->values[i] = read_tagged_int(r);
	}
	if (r->status)
		return NULL;
	define(r, SIG_ENUM, id, sig);
	return sig;
}

static const struct trace_bitmask_sig *read_bitmask_sig(struct trace_reader *r)
{
	uint64_t id = read_uint(r);
	struct trace_bitmask_sig *sig = known_sig(r, SIG_BITMASK, id);
	void **slot;
	uint64_t n;

	if (sig)
		return sig;
	slot = slot_of(r, SIG_BITMASK, id);
	if (!slot || *slot)
		return slot ? *slot : NULL;
	n = read_uint(r);
	if (n > 65536)
		fail_at(r, "a bitmask with too many names");
	if (r->status)
		return NULL;
	sig = take(r, &r->sigs, sizeof(*sig));
	if (!sig || !(sig->names = take(r, &r->sigs, (n + 1) * sizeof(*sig->names))) ||
	    !(sig->values = take(r, &r->sigs, (n + 1) * sizeof(*sig->values))))
		return NULL;
	sig->n = (uint32_t)n;
	for (uint64_t i = 0; i < n; i++) {
		if (!(sig->names[i] = read_string(r, &r->sigs, NULL)))
			return NULL;
		sig->values[i] = read_uint(r);
	}
	if (r->status)
		return NULL;
	define(r, SIG_BITMASK, id, sig);
	return sig;
}

static const struct trace_struct_sig *read_struct_sig(struct trace_reader *r)
{
	uint64_t id = read_uint(r);
	void **slot = slot_of(r, SIG_STRUCT, id);
	struct trace_struct_sig *sig;
	uint64_t n;

	if (!slot || *slot)
		return slot ? *slot : NULL;
	sig = take(r, &r->sigs, sizeof(*sig));
	if (!sig || !(sig->name = read_string(r, &r->sigs, NULL)))
		return NULL;
	n = read_uint(r);
	if (r->status)
		return NULL;
	sig->members = read_names(r, n);
	if (!sig->members)
		return NULL;
	sig->n = (uint32_t)n;
	define(r, SIG_STRUCT, id, sig);
	return sig;
}

/* ---- values ---- */

static void read_value(struct trace_reader *r, struct arena *a, struct trace_value *v, unsigned depth);

static const struct trace_value *read_items(struct trace_reader *r, struct arena *a, uint64_t n, unsigned depth)
{
	/* Room for what is there at most: an item takes a byte at least, and the count is not believed. */
	size_t room = n < 4096 ? (size_t)n : 4096;
	struct trace_value *items = take(r, a, (room + !room) * sizeof(*items));

	if (depth > MAX_DEPTH)
		fail_at(r, "values nested too deep");
	for (uint64_t i = 0; items && i < n && r->status == 0; i++) {
		if (i == room) {
			struct trace_value *grown;
			room = n - i < room ? (size_t)n : 2 * room;
			grown = take(r, a, room * sizeof(*items));
			if (grown)
				memcpy(grown, items, (size_t)i * sizeof(*items));
			items = grown;
			if (!items)
				break;
		}
		read_value(r, a, &items[i], depth + 1);
	}
	return items;
}

static void read_wide(struct trace_reader *r, struct arena *a, struct trace_value *v)
{
	uint32_t *wide;

	v->count = read_uint(r);
	if (v->count > (1u << 20)) {
		fail_at(r, "a wide string of impossible size");
		return;
	}
	v->wide = wide = take(r, a, (v->count + 1) * sizeof(*wide));
	for (uint64_t i = 0; wide && i < v->count && r->status == 0; i++)
		wide[i] = (uint32_t)read_uint(r);
}

static void read_value(struct trace_reader *r, struct arena *a, struct trace_value *v, unsigned depth)
{
	unsigned tag = read_byte(r);

	v->type = (enum trace_type)tag;
	v->sig = NULL;
	v->count = 0;
	v->u = 0;
	switch (tag) {
	case TRACE_NULL:
	case TRACE_FALSE:
		break;
	case TRACE_TRUE:
		v->u = 1;
		break;
	case TRACE_SINT:
		v->i = (int64_t)-read_uint(r);
		break;
	case TRACE_UINT:
	case TRACE_OPAQUE:
		v->u = read_uint(r);
		break;
	case TRACE_FLOAT:
		read_bytes(r, &v->f, 4);
		break;
	case TRACE_DOUBLE:
		read_bytes(r, &v->d, 8);
		break;
	case TRACE_STRING:
		v->str = read_string(r, a, &v->count);
		break;
	case TRACE_BLOB:
		v->count = read_uint(r);
		if (r->status == 0)
			v->blob = read_block(r, a, v->count);
		break;
	case TRACE_ENUM:
		v->sig = read_enum_sig(r);
		if (v->sig && r->version < 3)
			v->i = ((const struct trace_enum_sig *)v->sig)->values[0];
		else if (v->sig)
			v->i = read_tagged_int(r);
		break;
	case TRACE_BITMASK:
		v->sig = read_bitmask_sig(r);
		if (v->sig)
			v->u = read_uint(r);
		break;
	case TRACE_ARRAY:
		v->count = read_uint(r);
		if (r->status == 0)
			v->items = read_items(r, a, v->count, depth);
		break;
	case TRACE_STRUCT:
		v->sig = read_struct_sig(r);
		if (!v->sig)
			break;
		v->count = ((const struct trace_struct_sig *)v->sig)->n;
		v->items = read_items(r, a, v->count, depth);
		break;
	case TRACE_REPR:
		v->count = 2;
		v->items = read_items(r, a, 2, depth);
		break;
	case TRACE_WSTRING:
		read_wide(r, a, v);
		break;
	default:
		fail_at(r, "a value of unknown type");
	}
}

/* ---- the quick way ---- */

/*
 * Nearly all that a trace holds are short numbers, known enums and floats within a piece. These functions read them without
 * looking for the piece's end at every byte, and without a store to the reader that the compiler could not keep in a
 * register; what is anything else they leave, untouched, to the functions above.
 */
#define QUICK_BYTES 32 /* more than any value without items takes: tag, two numbers and a tag between them */

/* A value without items at p, of which QUICK_BYTES can be read. @return behind it; NULL: not a quick one, v is untouched */
static inline const uint8_t *quick_scalar(const struct trace_reader *r, const uint8_t *p, struct trace_value *v)
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
		*v = (struct trace_value){ .type = TRACE_FLOAT };
		memcpy(&v->f, p, 4);
		return p + 4;
	case TRACE_DOUBLE:
		*v = (struct trace_value){ .type = TRACE_DOUBLE };
		memcpy(&v->d, p, 8);
		return p + 8;
	case TRACE_SINT:
		p = quick_uint(p, &bits);
		bits = -bits;
		break;
	case TRACE_UINT:
	case TRACE_OPAQUE:
		p = quick_uint(p, &bits);
		break;
	case TRACE_ENUM:
		p = quick_uint(p, &bits);
		sig = p ? known_sig(r, SIG_ENUM, bits) : NULL;
		if (!sig || r->version < 3)
			return NULL;
		sign = *p++;
		if (sign != TRACE_SINT && sign != TRACE_UINT)
			return NULL;
		p = quick_uint(p, &bits);
		bits = sign == TRACE_SINT ? -bits : bits;
		break;
	case TRACE_BITMASK:
		p = quick_uint(p, &bits);
		sig = p ? known_sig(r, SIG_BITMASK, bits) : NULL;
		if (!sig)
			return NULL;
		p = quick_uint(p, &bits);
		break;
	default:
		return NULL;
	}
	if (p)
		*v = (struct trace_value){ .type = (enum trace_type)tag, .sig = sig, .u = bits };
	return p;
}

/* An array of quick values: the vectors and matrices of GL. As quick_scalar. */
static const uint8_t *quick_array(struct trace_reader *r, const uint8_t *p, struct arena *a, struct trace_value *v)
{
	struct trace_value *items;
	uint64_t n = p[1];

	if (n == 0 || n > 16)
		return NULL;
	items = arena_alloc(a, n * sizeof(*items));
	p += 2;
	for (uint64_t i = 0; i < n && items && p; i++)
		p = r->end - p >= QUICK_BYTES ? quick_scalar(r, p, &items[i]) : NULL;
	if (items && p)
		*v = (struct trace_value){ .type = TRACE_ARRAY, .count = n, .items = items };
	return items ? p : NULL;
}

/*
 * Details at p as long as they are quick ones.
 * @param whole  receives 1: these were all; 0: read_details goes on
 * @return behind them
 */
static inline const uint8_t *quick_details(struct trace_reader *r, const uint8_t *p, struct pending *pending, int *whole)
{
	const uint8_t *next, *const end = r->end;
	const uint32_t n_args = pending->call.n_args < 0x80 ? pending->call.n_args : 0x80;
	struct trace_value *v;

	*whole = 0;
	while (end - p >= QUICK_BYTES + 2) {
		if (*p == 1 && p[1] < n_args) {
			v = &pending->args[p[1]];
			next = p + 2;
		} else if (*p == 2) {
			v = &pending->call.ret;
			next = p + 1;
		} else {
			*whole = *p == 0;
			p += *whole;
			break;
		}
		next = *next == TRACE_ARRAY ? quick_array(r, next, &pending->arena, v) : quick_scalar(r, next, v);
		if (!next)
			break;
		p = next;
	}
	return p;
}

/* ---- events ---- */

static void skip_backtrace(struct trace_reader *r, struct arena *a)
{
	uint64_t n = read_uint(r);

	for (uint64_t i = 0; i < n && r->status == 0; i++) {
		uint64_t id = read_uint(r);
		void **slot = slot_of(r, SIG_FRAME, id);
		if (!slot || *slot)
			continue;
		define(r, SIG_FRAME, id, r); /* seen; nobody wants what it says */
		for (unsigned tag = read_byte(r); tag && r->status == 0; tag = read_byte(r)) {
			if (tag <= 3)
				read_string(r, a, NULL);
			else if (tag <= 5)
				read_uint(r);
			else
				fail_at(r, "a stack frame of unknown form");
		}
	}
}

static void read_details(struct trace_reader *r, struct pending *p)
{
	struct call *call = &p->call;

	for (;;) {
		unsigned tag = read_byte(r);
		uint64_t index;
		if (r->status)
			return;
		switch (tag) {
		case 0:
			return;
		case 1:
			index = read_uint(r);
			if (index >= MAX_ARGS) {
				fail_at(r, "an argument's number is out of all measure");
				return;
			}
			for (; call->n_args <= index; call->n_args++)
				p->args[call->n_args].type = TRACE_NONE;
			read_value(r, &p->arena, &p->args[index], 0);
			if (r->status)
				p->args[index].type = TRACE_NONE;
			break;
		case 2:
			read_value(r, &p->arena, &call->ret, 0);
			if (r->status)
				call->ret.type = TRACE_NONE;
			break;
		case 4:
			skip_backtrace(r, &p->arena);
			break;
		case 5:
			call->flags |= (uint32_t)read_uint(r);
			break;
		default:
			fail_at(r, "a detail of unknown kind");
		}
		if (r->status)
			return;
	}
}

static struct pending *new_pending(struct trace_reader *r)
{
	struct pending **grown, *p;

	if (r->entered && !r->entered->in_use)
		return r->entered;
	for (size_t i = 0; i < r->n_pending; i++)
		if (!r->pending[i]->in_use)
			return r->entered = r->pending[i];
	if (r->n_pending == MAX_PENDING) {
		fail_at(r, "too many calls that never returned");
		return NULL;
	}
	grown = realloc(r->pending, (r->n_pending + 1) * sizeof(*grown));
	if (grown)
		r->pending = grown;
	p = grown ? calloc(1, sizeof(*p)) : NULL;
	if (!p) {
		r->status = err_report(ERR_SYSTEM, r->path, "out of memory");
		return NULL;
	}
	r->pending[r->n_pending++] = p;
	return r->entered = p;
}

static void release_pending(struct pending *p)
{
	if (p->arena.current)
		arena_reset(&p->arena, ARENA_KEEP);
	p->in_use = 0;
}

static void begin_call(struct pending *p, uint64_t thread, const struct call_sig *sig)
{
	const uint32_t n = sig->n_args;

	p->call = (struct call){ .thread = thread, .sig = sig, .n_args = n, .args = p->args, .ret.type = TRACE_NONE };
	for (uint32_t i = 0; i < n; i++)
		p->args[i].type = TRACE_NONE;
}

/* The details of an ENTER event, from r->p on, and its end. */
static void end_enter(struct trace_reader *r, struct pending *p)
{
	read_details(r, p);
	if (r->status) {
		release_pending(p);
		return;
	}
	p->call.number = r->next_number++;
	p->in_use = 1;
}

static void read_enter(struct trace_reader *r)
{
	struct pending *p = new_pending(r);
	const struct call_sig *sig;
	uint64_t thread;

	if (!p)
		return;
	thread = r->version >= 4 ? read_uint(r) : 0;
	sig = read_call_sig(r);
	if (!sig)
		return;
	begin_call(p, thread, sig);
	end_enter(r, p);
}

/* @return the call that has returned, or NULL: failed, or a call that nobody knows */
static struct pending *read_leave(struct trace_reader *r)
{
	uint64_t number = read_uint(r);
	struct pending *p = NULL, unknown;

	if (r->entered && r->entered->in_use && r->entered->call.number == number)
		p = r->entered;
	for (size_t i = 0; i < r->n_pending && !p; i++)
		if (r->pending[i]->in_use && r->pending[i]->call.number == number)
			p = r->pending[i];
	if (p) {
		read_details(r, p);
		/* Cut within the return: the call itself is whole, and end_of_calls delivers it. */
		return r->status ? NULL : p;
	}
	memset(&unknown, 0, sizeof(unknown));
	read_details(r, &unknown);
	arena_free(&unknown.arena);
	return NULL;
}

/*
 * The next call, if its ENTER begins the quick way and its LEAVE follows at once. Whatever is not so is left to the usual
 * way, which goes on where r->p is then.
 * @return the call that has returned, or NULL: the next event is to be read, or failed
 */
static struct pending *quick_call(struct trace_reader *r)
{
	const uint8_t *p = r->p;
	const struct call_sig *sig;
	struct pending *entered;
	uint64_t thread, number;
	int whole;

	if (r->end - p < QUICK_BYTES || *p != 0 || r->version < 4)
		return NULL;
	p = quick_uint(p + 1, &thread);
	p = p ? quick_uint(p, &number) : NULL;
	sig = p ? known_sig(r, SIG_CALL, number) : NULL;
	entered = sig ? new_pending(r) : NULL;
	if (!entered)
		return NULL;
	begin_call(entered, thread, sig);
	p = quick_details(r, p, entered, &whole);
	if (whole) {
		entered->call.number = r->next_number++;
		entered->in_use = 1;
	} else {
		r->p = p;
		end_enter(r, entered);
		if (r->status)
			return NULL;
		p = r->p;
	}
	r->p = p;
	if (r->end - p < QUICK_BYTES || *p != 1 || !(p = quick_uint(p + 1, &number)) || number != entered->call.number)
		return NULL;
	p = quick_details(r, p, entered, &whole);
	r->p = p;
	if (!whole)
		read_details(r, entered);
	return r->status ? NULL : entered;
}

/* At the end: calls that were entered and never left, in order. */
static struct pending *end_of_calls(struct trace_reader *r)
{
	struct pending *oldest = NULL;

	if (r->status == 1 && !r->ended) {
		r->ended = 1;
		r->cut |= container_is_cut(r->container);
		if (r->cut)
			err_warn(r->path, "the file is cut short after call %llu; frames before it are whole",
			         (unsigned long long)r->next_number);
	}
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use && (!oldest || r->pending[i]->call.number < oldest->call.number))
			oldest = r->pending[i];
	if (oldest)
		oldest->call.incomplete = 1;
	return oldest;
}

/* The usual way. @return the call that has returned by it, or NULL */
static struct pending *read_event(struct trace_reader *r)
{
	unsigned event = read_byte(r);

	if (event == 1)
		return read_leave(r);
	if (event == 0)
		read_enter(r);
	else
		fail_at(r, "an event of unknown kind");
	return NULL;
}

int trace_reader_next(struct trace_reader *r, const struct call **call)
{
	struct pending *p = NULL;

	*call = NULL;
	if (r->delivered)
		release_pending(r->delivered);
	r->delivered = NULL;
	while (!p && r->status == 0) {
		if (r->p == r->end && !refill(r))
			break;
		p = quick_call(r);
		if (!p && r->status == 0 && r->p != r->end)
			p = read_event(r);
		if (r->status == 1)
			r->cut = 1;
	}
	if (!p && r->status == 1)
		p = end_of_calls(r);
	if (!p)
		return r->status < 0 ? r->status : 0;
	r->delivered = p;
	*call = &p->call;
	return 1;
}

/* ---- coming back ---- */

int trace_reader_place(const struct trace_reader *r, struct trace_place *place)
{
	*place = (struct trace_place){ container_piece(r->container), r->piece_start,
	                               r->piece_start + (uint64_t)(r->p - r->piece), r->next_number };
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use && r->pending[i] != r->delivered)
			return 0;
	return r->status == 0;
}

static void put_texts(struct bytes *b, const char **texts, uint32_t n)
{
	bytes_put_u64(b, n);
	for (uint32_t i = 0; i < n; i++)
		bytes_put_text(b, texts[i]);
}

int trace_reader_signatures(const struct trace_reader *r, uint8_t **out, size_t *n)
{
	struct bytes b = { .n = 0 };

	for (size_t i = 0; i < r->n_definitions; i++) {
		const struct definition *d = &r->definitions[i];
		const void *sig = r->tables[d->kind].items[d->id];
		bytes_put_u64(&b, d->kind);
		bytes_put_u64(&b, d->id);
		bytes_put_u64(&b, d->offset);
		if (d->kind == SIG_CALL) {
			bytes_put_text(&b, ((const struct call_sig *)sig)->name);
			put_texts(&b, ((const struct call_sig *)sig)->arg_names, ((const struct call_sig *)sig)->n_args);
		} else if (d->kind == SIG_STRUCT) {
			bytes_put_text(&b, ((const struct trace_struct_sig *)sig)->name);
			put_texts(&b, ((const struct trace_struct_sig *)sig)->members, ((const struct trace_struct_sig *)sig)->n);
		} else if (d->kind == SIG_ENUM || d->kind == SIG_BITMASK) { /* the two structs differ in the sign alone */
			const struct trace_bitmask_sig *values = sig;
			put_texts(&b, values->names, values->n);
			bytes_put(&b, values->values, values->n * sizeof(*values->values));
		}
	}
	*out = b.data;
	*n = b.n;
	if (!b.failed)
		return 0;
	free(b.data);
	return err_report(ERR_SYSTEM, r->path, "out of memory");
}

static const char *get_text(struct trace_reader *r, struct cursor *c)
{
	uint64_t n = cursor_u64(c);
	const uint8_t *at = n < UINT64_MAX ? cursor_get(c, n + 1) : NULL;
	char *text = at && at[n] == 0 ? take(r, &r->sigs, (size_t)n + 1) : NULL;

	if (!text) {
		c->failed = 1;
		return NULL;
	}
	return memcpy(text, at, (size_t)n + 1);
}

static const char **get_texts(struct trace_reader *r, struct cursor *c, uint32_t *n)
{
	uint64_t count = cursor_u64(c);
	const char **texts = count <= 65536 ? take(r, &r->sigs, (size_t)(count + 1) * sizeof(*texts)) : NULL;

	c->failed |= !texts;
	for (uint64_t i = 0; i < count && !c->failed; i++)
		texts[i] = get_text(r, c);
	*n = (uint32_t)count;
	return texts;
}

/* A signature as trace_reader_signatures wrote it, in the reader's memory; NULL: no such thing. */
static void *get_signature(struct trace_reader *r, struct cursor *c, uint64_t kind, uint64_t id)
{
	struct call_sig *call;
	struct trace_struct_sig *members;
	struct trace_bitmask_sig *values;
	const uint8_t *numbers;

	switch (kind) {
	case SIG_CALL:
		call = take(r, &r->sigs, sizeof(*call));
		if (!call)
			return NULL;
		call->id = id;
		call->name = get_text(r, c);
		call->arg_names = get_texts(r, c, &call->n_args);
		call->command = c->failed ? -1 : gls_command_find(call->name);
		return call->n_args <= MAX_ARGS ? call : NULL;
	case SIG_STRUCT:
		members = take(r, &r->sigs, sizeof(*members));
		if (!members)
			return NULL;
		members->name = get_text(r, c);
		members->members = get_texts(r, c, &members->n);
		return members;
	case SIG_ENUM:
	case SIG_BITMASK:
		values = take(r, &r->sigs, sizeof(*values));
		if (!values)
			return NULL;
		values->names = get_texts(r, c, &values->n);
		numbers = c->failed ? NULL : cursor_get(c, (uint64_t)values->n * sizeof(*values->values));
		values->values = numbers ? take(r, &r->sigs, (values->n + 1) * sizeof(*values->values)) : NULL;
		if (!values->values)
			return NULL;
		memcpy(values->values, numbers, values->n * sizeof(*values->values));
		return values;
	case SIG_FRAME:
		return r;
	default:
		return NULL;
	}
}

/* Know exactly the signatures that are defined before a place. */
static int learn_signatures(struct trace_reader *r, const uint8_t *signatures, size_t n, uint64_t offset)
{
	struct cursor c = { signatures, signatures + n, 0 };

	for (size_t i = 0; i < r->n_definitions; i++)
		if (r->definitions[i].offset > offset)
			r->tables[r->definitions[i].kind].items[r->definitions[i].id] = NULL;
	while (r->n_definitions && r->definitions[r->n_definitions - 1].offset > offset)
		r->n_definitions--;
	while (c.p < c.end && !c.failed) {
		uint64_t kind = cursor_u64(&c), id = cursor_u64(&c), defined = cursor_u64(&c);
		void **slot, *sig;
		if (c.failed || kind >= N_SIG_KINDS || defined > offset)
			break;
		slot = slot_of(r, (enum sig_kind)kind, id);
		sig = slot ? get_signature(r, &c, kind, id) : NULL;
		if (!sig || c.failed || r->status)
			return err_report(ERR_INPUT, r->path, "its index holds no signatures where they should be");
		if (*slot)
			continue;
		define(r, (enum sig_kind)kind, id, sig);
		r->definitions[r->n_definitions - 1].offset = defined;
	}
	return r->status;
}

int trace_reader_seek(struct trace_reader *r, const struct trace_place *place, const uint8_t *signatures, size_t n)
{
	uint64_t piece = place->piece == UINT64_MAX ? 0 : place->piece;
	int rc = container_seek(r->container, piece);

	if (rc)
		return rc;
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use)
			release_pending(r->pending[i]);
	r->delivered = NULL;
	r->status = r->ended = r->cut = 0;
	r->piece = r->p = r->end = NULL;
	r->piece_start = piece ? place->piece_start : 0;
	rc = learn_signatures(r, signatures, n, place->offset);
	if (rc)
		return rc;
	do {
		if (!refill(r))
			return r->status < 0 ? r->status : err_report(ERR_INPUT, r->path, "is shorter than its index says");
	} while (r->piece_start + (uint64_t)(r->end - r->piece) < place->offset);
	if (place->offset < r->piece_start)
		return err_report(ERR_INPUT, r->path, "its index names a place that is not there");
	r->p = r->piece + (place->offset - r->piece_start);
	r->next_number = place->number;
	return 0;
}

/* ---- opening ---- */

static int read_header(struct trace_reader *r)
{
	uint64_t semantic = 0;

	r->version = (unsigned)read_uint(r);
	if (r->status == 0 && r->version > FORMAT_NEWEST)
		return err_report(ERR_INPUT, r->path, "not a trace, or one of format %u, which is newer than %u", r->version,
		                  FORMAT_NEWEST);
	if (r->version >= 6)
		semantic = read_uint(r);
	if (r->status == 0 && semantic > r->version)
		return err_report(ERR_INPUT, r->path, "not a trace: its header makes no sense");
	while (r->version >= 6 && r->status == 0) {
		const char *name = read_string(r, &r->sigs, NULL), *value;
		if (!name || !*name)
			break;
		value = read_string(r, &r->sigs, NULL);
		if (value && r->n_properties < MAX_PROPERTIES) {
			r->properties[r->n_properties][0] = name;
			r->properties[r->n_properties++][1] = value;
		}
	}
	if (r->status == 1 && r->piece_start == 0 && container_size(r->container) <= 2)
		return err_report(ERR_INPUT, r->path, "holds no calls yet: the program ended before anything was written");
	if (r->status == 1)
		return err_report(ERR_INPUT, r->path, "cut within its header; nothing can be read from it");
	return r->status;
}

int trace_reader_open(struct trace_reader **out, const char *path)
{
	struct trace_reader *r = calloc(1, sizeof(*r));
	int rc = ERR_SYSTEM;

	*out = NULL;
	if (!r || !(r->path = strdup(path))) {
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	rc = container_open(&r->container, path);
	if (rc)
		goto fail;
	rc = read_header(r);
	if (rc)
		goto fail;
	*out = r;
	return 0;
fail:
	trace_reader_close(&r);
	return rc;
}

void trace_reader_close(struct trace_reader **reader)
{
	struct trace_reader *r = *reader;

	if (!r)
		return;
	container_close(&r->container);
	for (size_t i = 0; i < r->n_pending; i++) {
		arena_free(&r->pending[i]->arena);
		free(r->pending[i]);
	}
	free(r->pending);
	for (unsigned kind = 0; kind < N_SIG_KINDS; kind++)
		free(r->tables[kind].items);
	free(r->definitions);
	arena_free(&r->sigs);
	free(r->path);
	free(r);
	*reader = NULL;
}

const char *trace_reader_property(const struct trace_reader *r, const char *name)
{
	for (size_t i = 0; i < r->n_properties; i++)
		if (strcmp(r->properties[i][0], name) == 0)
			return r->properties[i][1];
	return NULL;
}

int trace_reader_property_at(const struct trace_reader *r, size_t i, const char **name, const char **value)
{
	if (i >= r->n_properties)
		return 0;
	*name = r->properties[i][0];
	*value = r->properties[i][1];
	return 1;
}

int trace_reader_is_cut(const struct trace_reader *r)
{
	return r->cut;
}

int trace_reader_hash_begin(struct trace_reader *r)
{
	return container_hash_begin(r->container);
}

int trace_reader_hash_end(struct trace_reader *r, uint64_t out[2])
{
	return container_hash_end(r->container, out);
}

uint64_t trace_reader_offset(const struct trace_reader *r)
{
	return container_offset(r->container);
}

uint64_t trace_reader_size(const struct trace_reader *r)
{
	return container_size(r->container);
}

const char *trace_enum_name(const struct trace_value *v)
{
	const struct trace_enum_sig *sig = v->type == TRACE_ENUM ? v->sig : NULL;

	for (uint32_t i = 0; sig && i < sig->n; i++)
		if (sig->values[i] == v->i)
			return sig->names[i];
	return NULL;
}
