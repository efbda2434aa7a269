/* Encodes calls as a new trace. */
#include "replay/trace/trace_out.h"

#include <errno.h>
#include <limits.h>
#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/part.h"

#define CHUNK_BYTES ((size_t)1 << 20) /* limit of apitrace's reader */

struct known { /* a signature that has been written */
	const void *sig;
	uint64_t id;
};

struct trace_out {
	char *path;
	char part[PATH_MAX];
	FILE *file;
	int rc;
	uint64_t bytes, n_calls, n_ids[N_TRACE_SIG_KINDS];
	struct known *known; /* hash table with open addressing, at most half full */
	size_t n_known, room;
	size_t n; /* number of bytes in the chunk */
	uint8_t chunk[CHUNK_BYTES];
	char packed[];
};

/* ---- bytes ---- */

static void write_file(struct trace_out *o, const void *data, size_t n)
{
	if (!o->rc && fwrite(data, 1, n, o->file) != n)
		o->rc = err_report(ERR_SYSTEM, o->path, "cannot be written: %s", strerror(errno));
	o->bytes += n;
}

static void end_chunk(struct trace_out *o)
{
	size_t packed = snappy_max_compressed_length(CHUNK_BYTES);
	uint8_t head[4];

	if (o->n == 0 || o->rc)
		return;
	if (snappy_compress((const char *)o->chunk, o->n, o->packed, &packed) != SNAPPY_OK) {
		o->rc = err_report(ERR_SYSTEM, o->path, "%zu bytes cannot be packed", o->n);
		return;
	}
	for (unsigned i = 0; i < 4; i++)
		head[i] = (uint8_t)(packed >> (8 * i));
	write_file(o, head, 4);
	write_file(o, o->packed, packed);
	o->n = 0;
}

static void put(struct trace_out *o, const void *data, size_t n)
{
	const uint8_t *from = data;

	while (n && !o->rc) {
		size_t here = CHUNK_BYTES - o->n < n ? CHUNK_BYTES - o->n : n;

		memcpy(o->chunk + o->n, from, here);
		o->n += here;
		from += here;
		n -= here;
		if (o->n == CHUNK_BYTES)
			end_chunk(o);
	}
}

static void put_byte(struct trace_out *o, unsigned byte)
{
	put(o, &(uint8_t){ (uint8_t)byte }, 1);
}

static void put_uint(struct trace_out *o, uint64_t v)
{
	uint8_t bytes[10];
	size_t n = 0;

	for (; v > 0x7f; v >>= 7)
		bytes[n++] = (uint8_t)(v | 0x80);
	bytes[n++] = (uint8_t)v;
	put(o, bytes, n);
}

static void put_text(struct trace_out *o, const char *text)
{
	size_t n = strlen(text);

	put_uint(o, n);
	put(o, text, n);
}

static void put_number(struct trace_out *o, int64_t v)
{
	put_byte(o, v < 0 ? TRACE_SINT : TRACE_UINT);
	put_uint(o, v < 0 ? -(uint64_t)v : (uint64_t)v);
}

/* ---- signatures ---- */

static struct known *slot_of(struct known *known, size_t room, const void *sig)
{
	size_t at = (size_t)((uintptr_t)sig * 0x9E3779B97F4A7C15u >> 20) & (room - 1);

	while (known[at].sig && known[at].sig != sig)
		at = (at + 1) & (room - 1);
	return &known[at];
}

/* Write a signature's number. @return 1 if this is its first use: the definition must follow */
static int put_signature(struct trace_out *o, enum trace_sig_kind kind, const void *sig)
{
	struct known *slot;

	if (2 * (o->n_known + 1) > o->room) {
		size_t room = o->room ? 2 * o->room : 1024;
		struct known *grown = calloc(room, sizeof(*grown));

		if (!grown) {
			o->rc = err_report(ERR_SYSTEM, o->path, "out of memory");
			return 0;
		}
		for (size_t i = 0; i < o->room; i++)
			if (o->known[i].sig)
				*slot_of(grown, room, o->known[i].sig) = o->known[i];
		free(o->known);
		o->known = grown;
		o->room = room;
	}
	slot = slot_of(o->known, o->room, sig);
	if (slot->sig) {
		put_uint(o, slot->id);
		return 0;
	}
	*slot = (struct known){ sig, o->n_ids[kind]++ };
	o->n_known++;
	put_uint(o, slot->id);
	return 1;
}

static void put_names(struct trace_out *o, const char *name, const char *const *names, uint32_t n)
{
	put_text(o, name);
	put_uint(o, n);
	for (uint32_t i = 0; i < n; i++)
		put_text(o, names[i]);
}

/* Write the signature of an enum or a bitmask. */
static void put_values_signature(struct trace_out *o, enum trace_sig_kind kind, const struct trace_values_sig *sig)
{
	if (!put_signature(o, kind, sig))
		return;
	put_uint(o, sig->n);
	for (uint32_t i = 0; i < sig->n; i++) {
		put_text(o, sig->names[i]);
		if (kind == TRACE_SIG_ENUM)
			put_number(o, (int64_t)sig->values[i]);
		else
			put_uint(o, sig->values[i]);
	}
}

/* ---- values and calls ---- */

static void put_value(struct trace_out *o, const struct trace_value *v)
{
	const struct trace_struct_sig *members;

	if (v->type == TRACE_SINT || v->type == TRACE_UINT) {
		put_byte(o, v->type);
		put_uint(o, v->type == TRACE_SINT ? -(uint64_t)v->i : v->u);
		return;
	}
	put_byte(o, (unsigned)v->type);
	switch (v->type) {
	case TRACE_FLOAT:
		put(o, &v->f, sizeof(v->f));
		break;
	case TRACE_DOUBLE:
		put(o, &v->d, sizeof(v->d));
		break;
	case TRACE_STRING:
	case TRACE_BLOB:
		put_uint(o, v->count);
		put(o, v->blob, v->count);
		break;
	case TRACE_ENUM:
		put_values_signature(o, TRACE_SIG_ENUM, v->sig);
		put_number(o, v->i);
		break;
	case TRACE_BITMASK:
		put_values_signature(o, TRACE_SIG_BITMASK, v->sig);
		put_uint(o, v->u);
		break;
	case TRACE_STRUCT:
		members = v->sig;
		if (put_signature(o, TRACE_SIG_STRUCT, members))
			put_names(o, members->name, members->members, members->n);
		break;
	case TRACE_ARRAY:
	case TRACE_WSTRING:
		put_uint(o, v->count);
		break;
	case TRACE_OPAQUE:
		put_uint(o, v->u);
		break;
	default: /* null, booleans and pairs: the tag says it all */
		break;
	}
	if (v->type == TRACE_WSTRING)
		for (uint64_t i = 0; i < v->count && !o->rc; i++)
			put_uint(o, v->wide[i]);
	if (v->type == TRACE_ARRAY || v->type == TRACE_STRUCT || v->type == TRACE_REPR)
		for (uint64_t i = 0; i < v->count && !o->rc; i++)
			put_value(o, &v->items[i]);
}

int trace_out_call(struct trace_out *o, const struct call *call)
{
	put_byte(o, TRACE_ENTER);
	put_uint(o, call->thread);
	if (put_signature(o, TRACE_SIG_CALL, call->sig))
		put_names(o, call->sig->name, call->sig->arg_names, call->sig->n_args);
	if (call->flags) {
		put_byte(o, TRACE_DETAIL_FLAGS);
		put_uint(o, call->flags);
	}
	for (uint32_t i = 0; i < call->n_args; i++)
		if (call->args[i].type != TRACE_NONE) {
			put_byte(o, TRACE_DETAIL_ARGUMENT);
			put_uint(o, i);
			put_value(o, &call->args[i]);
		}
	put_byte(o, TRACE_DETAIL_END);
	put_byte(o, TRACE_LEAVE);
	put_uint(o, o->n_calls++);
	if (call->ret.type != TRACE_NONE) {
		put_byte(o, TRACE_DETAIL_RESULT);
		put_value(o, &call->ret);
	}
	put_byte(o, TRACE_DETAIL_END);
	return o->rc;
}

/* ---- opening and closing ---- */

static void release(struct trace_out **out)
{
	free((*out)->known);
	free((*out)->path);
	free(*out);
	*out = NULL;
}

static int same_file(const char *a, const char *b)
{
	struct stat x, y;

	return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

int trace_out_open(struct trace_out **out, const char *path, const char *from_path, const struct trace_reader *from)
{
	struct trace_out *o;
	const char *name, *value;

	*out = NULL;
	if (same_file(path, from_path))
		return err_report(ERR_USAGE, path, "is the recording itself; give the new one another name");
	*out = o = calloc(1, sizeof(*o) + snappy_max_compressed_length(CHUNK_BYTES));
	if (!o || !(o->path = strdup(path))) {
		free(o);
		*out = NULL;
		return err_report(ERR_SYSTEM, path, "out of memory");
	}
	o->rc = part_begin(path, o->part, sizeof(o->part));
	if (!o->rc && !(o->file = fopen(o->part, "wb")))
		o->rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	if (o->rc) {
		int rc = o->rc;
		trace_out_drop(out);
		return rc;
	}
	write_file(o, "at", 2);
	put_uint(o, TRACE_VERSION);
	put_uint(o, TRACE_SEMANTICS);
	for (size_t i = 0; trace_reader_property_at(from, i, &name, &value); i++) {
		put_text(o, name);
		put_text(o, value);
	}
	put_byte(o, 0);
	return 0;
}

int trace_out_finish(struct trace_out **out, uint64_t *bytes)
{
	struct trace_out *o = *out;
	int rc;

	end_chunk(o);
	if (fclose(o->file) && !o->rc)
		o->rc = err_report(ERR_SYSTEM, o->path, "cannot be written: %s", strerror(errno));
	o->file = NULL;
	rc = o->rc;
	if (bytes)
		*bytes = o->bytes;
	if (rc) {
		trace_out_drop(out);
		return rc;
	}
	rc = part_finish(o->part, o->path);
	release(out);
	return rc;
}

void trace_out_drop(struct trace_out **out)
{
	if (!*out)
		return;
	if ((*out)->file)
		fclose((*out)->file);
	if ((*out)->part[0])
		part_drop((*out)->part);
	release(out);
}
