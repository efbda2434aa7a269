#include "replay/trace/reader_sigs.h"

#include <stdlib.h>

#include "base/bytes.h"
#include "base/err.h"
#include "base/memory.h"

#define MAX_ID (1u << 20)
#define MAX_NAMES 65536u

/* ---- storage ---- */

/* The slot of an id, or NULL (failed). If the slot is empty, the definition follows. */
static void **slot_of(struct trace_reader *r, enum trace_sig_kind kind, uint64_t id)
{
	struct reader_sigs *t = &r->tables[kind];

	if (r->status)
		return NULL;
	if (id >= MAX_ID) {
		reader_fail(r, "a signature number that is too large");
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

/*
 * Store a complete signature, with the position where it ends, so that a seek can tell which signatures precede a
 * place.
 */
static void define(struct trace_reader *r, enum trace_sig_kind kind, uint64_t id, void *sig)
{
	if (MEMORY_GROW(r->definitions, r->definitions_room, r->n_definitions + 1)) {
		r->status = ERR_SYSTEM;
		return;
	}
	r->definitions[r->n_definitions++] =
		(struct reader_definition){ kind, id, r->piece_start + (uint64_t)(r->p - r->piece) };
	r->tables[kind].items[id] = sig;
}

static int32_t find_command(const struct trace_reader *r, const char *name)
{
	return r->find ? r->find(name) : -1;
}

/* ---- reading ---- */

static const char **read_names(struct trace_reader *r, uint64_t n)
{
	const char **names;

	if (n > MAX_NAMES) {
		reader_fail(r, "a signature with too many names");
		return NULL;
	}
	names = reader_alloc(r, &r->sigs, (n + 1) * sizeof(*names));
	for (uint64_t i = 0; names && i < n; i++)
		if (!(names[i] = reader_string(r, &r->sigs, NULL)))
			return NULL;
	return names;
}

int64_t reader_tagged_int(struct trace_reader *r)
{
	unsigned tag = reader_byte(r);
	uint64_t value;

	if (tag != TRACE_SINT && tag != TRACE_UINT) {
		if (r->status == 0)
			reader_fail(r, "an enum value that is not a number");
		return 0;
	}
	value = reader_uint(r);
	return tag == TRACE_SINT ? (int64_t)-value : (int64_t)value;
}

const struct call_sig *reader_call_sig(struct trace_reader *r)
{
	uint64_t id = reader_uint(r), n;
	struct call_sig *sig = reader_known_sig(r, TRACE_SIG_CALL, id);
	void **slot;

	if (sig)
		return sig;
	slot = slot_of(r, TRACE_SIG_CALL, id);
	if (!slot || *slot)
		return slot ? *slot : NULL;
	sig = reader_alloc(r, &r->sigs, sizeof(*sig));
	if (!sig)
		return NULL;
	sig->id = id;
	sig->name = reader_string(r, &r->sigs, NULL);
	n = reader_uint(r);
	if (!sig->name || r->status)
		return NULL;
	if (n > READER_MAX_ARGS) {
		reader_fail(r, "a call with too many arguments");
		return NULL;
	}
	sig->n_args = (uint32_t)n;
	sig->arg_names = read_names(r, n);
	if (!sig->arg_names)
		return NULL;
	sig->command = find_command(r, sig->name);
	define(r, TRACE_SIG_CALL, id, sig);
	return sig;
}

const struct trace_values_sig *reader_values_sig(struct trace_reader *r, enum trace_sig_kind kind)
{
	uint64_t id = reader_uint(r), n;
	struct trace_values_sig *sig = reader_known_sig(r, kind, id);
	void **slot;

	if (sig)
		return sig;
	slot = slot_of(r, kind, id);
	if (!slot || *slot)
		return slot ? *slot : NULL;
	n = kind == TRACE_SIG_ENUM && r->version < 3 ? 1 : reader_uint(r);
	if (n > MAX_NAMES)
		reader_fail(r, kind == TRACE_SIG_ENUM ? "an enum with too many names" : "a bitmask with too many names");
	if (r->status)
		return NULL;
	sig = reader_alloc(r, &r->sigs, sizeof(*sig));
	if (!sig || !(sig->names = reader_alloc(r, &r->sigs, (n + 1) * sizeof(*sig->names))) ||
	    !(sig->values = reader_alloc(r, &r->sigs, (n + 1) * sizeof(*sig->values))))
		return NULL;
	sig->n = (uint32_t)n;
	for (uint64_t i = 0; i < n; i++) {
		if (!(sig->names[i] = reader_string(r, &r->sigs, NULL)))
			return NULL;
		sig->values[i] = kind == TRACE_SIG_ENUM ? (uint64_t)reader_tagged_int(r) : reader_uint(r);
	}
	if (r->status)
		return NULL;
	define(r, kind, id, sig);
	return sig;
}

const struct trace_struct_sig *reader_struct_sig(struct trace_reader *r)
{
	uint64_t id = reader_uint(r);
	void **slot = slot_of(r, TRACE_SIG_STRUCT, id);
	struct trace_struct_sig *sig;
	uint64_t n;

	if (!slot || *slot)
		return slot ? *slot : NULL;
	sig = reader_alloc(r, &r->sigs, sizeof(*sig));
	if (!sig || !(sig->name = reader_string(r, &r->sigs, NULL)))
		return NULL;
	n = reader_uint(r);
	if (r->status)
		return NULL;
	sig->members = read_names(r, n);
	if (!sig->members)
		return NULL;
	sig->n = (uint32_t)n;
	define(r, TRACE_SIG_STRUCT, id, sig);
	return sig;
}

int reader_frame_sig(struct trace_reader *r)
{
	uint64_t id = reader_uint(r);
	void **slot = slot_of(r, TRACE_SIG_FRAME, id);

	if (!slot || *slot)
		return 0;
	define(r, TRACE_SIG_FRAME, id, r); /* only marks it as seen; the contents are not needed */
	return 1;
}

/* ---- serializing, for an index ---- */

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
		const struct reader_definition *d = &r->definitions[i];
		const void *sig = r->tables[d->kind].items[d->id];
		bytes_put_u64(&b, d->kind);
		bytes_put_u64(&b, d->id);
		bytes_put_u64(&b, d->offset);
		if (d->kind == TRACE_SIG_CALL) {
			bytes_put_text(&b, ((const struct call_sig *)sig)->name);
			put_texts(&b, ((const struct call_sig *)sig)->arg_names, ((const struct call_sig *)sig)->n_args);
		} else if (d->kind == TRACE_SIG_STRUCT) {
			bytes_put_text(&b, ((const struct trace_struct_sig *)sig)->name);
			put_texts(&b, ((const struct trace_struct_sig *)sig)->members, ((const struct trace_struct_sig *)sig)->n);
		} else if (d->kind == TRACE_SIG_ENUM || d->kind == TRACE_SIG_BITMASK) {
			const struct trace_values_sig *values = sig;
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
	char *text = at && at[n] == 0 ? reader_alloc(r, &r->sigs, (size_t)n + 1) : NULL;

	if (!text) {
		c->failed = 1;
		return NULL;
	}
	return memcpy(text, at, (size_t)n + 1);
}

static const char **get_texts(struct trace_reader *r, struct cursor *c, uint32_t *n)
{
	uint64_t count = cursor_u64(c);
	const char **texts = count <= MAX_NAMES ? reader_alloc(r, &r->sigs, (size_t)(count + 1) * sizeof(*texts)) : NULL;

	c->failed |= !texts;
	for (uint64_t i = 0; i < count && !c->failed; i++)
		texts[i] = get_text(r, c);
	*n = (uint32_t)count;
	return texts;
}

/* A signature as trace_reader_signatures wrote it, in the reader's memory; NULL: invalid. */
static void *get_signature(struct trace_reader *r, struct cursor *c, uint64_t kind, uint64_t id)
{
	struct call_sig *call;
	struct trace_struct_sig *members;
	struct trace_values_sig *values;
	const uint8_t *numbers;

	switch (kind) {
	case TRACE_SIG_CALL:
		call = reader_alloc(r, &r->sigs, sizeof(*call));
		if (!call)
			return NULL;
		call->id = id;
		call->name = get_text(r, c);
		call->arg_names = get_texts(r, c, &call->n_args);
		call->command = c->failed ? -1 : find_command(r, call->name);
		return call->n_args <= READER_MAX_ARGS ? call : NULL;
	case TRACE_SIG_STRUCT:
		members = reader_alloc(r, &r->sigs, sizeof(*members));
		if (!members)
			return NULL;
		members->name = get_text(r, c);
		members->members = get_texts(r, c, &members->n);
		return members;
	case TRACE_SIG_ENUM:
	case TRACE_SIG_BITMASK:
		values = reader_alloc(r, &r->sigs, sizeof(*values));
		if (!values)
			return NULL;
		values->names = get_texts(r, c, &values->n);
		numbers = c->failed ? NULL : cursor_get(c, (uint64_t)values->n * sizeof(*values->values));
		values->values = numbers ? reader_alloc(r, &r->sigs, (values->n + 1) * sizeof(*values->values)) : NULL;
		if (!values->values)
			return NULL;
		memcpy(values->values, numbers, values->n * sizeof(*values->values));
		return values;
	case TRACE_SIG_FRAME:
		return r;
	default:
		return NULL;
	}
}

int reader_learn_sigs(struct trace_reader *r, const uint8_t *signatures, size_t n, uint64_t offset)
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
		if (c.failed || kind >= N_TRACE_SIG_KINDS || defined > offset)
			break;
		slot = slot_of(r, (enum trace_sig_kind)kind, id);
		sig = slot ? get_signature(r, &c, kind, id) : NULL;
		if (!sig || c.failed || r->status)
			return err_report(ERR_INPUT, r->path, "the signatures in its index are invalid");
		if (*slot)
			continue;
		define(r, (enum trace_sig_kind)kind, id, sig);
		r->definitions[r->n_definitions - 1].offset = defined;
	}
	return r->status;
}
