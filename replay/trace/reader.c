/* Opens traces, reads them call by call, and seeks. */
#include "replay/trace/reader.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/trace/container.h"
#include "replay/trace/reader_calls.h"
#include "replay/trace/reader_sigs.h"

int trace_reader_next(struct trace_reader *r, const struct call **call)
{
	if (r->delivered)
		reader_release_call(r->delivered);
	r->delivered = reader_next_call(r);
	*call = r->delivered ? &r->delivered->call : NULL;
	if (!*call)
		return r->status < 0 ? r->status : 0;
	return 1;
}

/* ---- seeking ---- */

int trace_reader_place(const struct trace_reader *r, struct trace_place *place)
{
	*place = (struct trace_place){ container_piece(r->container), r->piece_start,
	                               r->piece_start + (uint64_t)(r->p - r->piece), r->next_number };
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use && r->pending[i] != r->delivered)
			return 0;
	return r->status == 0;
}

int trace_reader_seek(struct trace_reader *r, const struct trace_place *place, const uint8_t *signatures, size_t n)
{
	uint64_t piece = place->piece == UINT64_MAX ? 0 : place->piece;
	int rc = container_seek(r->container, piece);

	if (rc)
		return rc;
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use)
			reader_release_call(r->pending[i]);
	r->delivered = NULL;
	r->status = r->ended = r->cut = 0;
	r->piece = r->p = r->end = NULL;
	r->piece_start = piece ? place->piece_start : 0;
	rc = reader_learn_sigs(r, signatures, n, place->offset);
	if (rc)
		return rc;
	do {
		if (!reader_refill(r))
			return r->status < 0 ? r->status : err_report(ERR_INPUT, r->path, "is shorter than its index says");
	} while (r->piece_start + (uint64_t)(r->end - r->piece) < place->offset);
	if (place->offset < r->piece_start)
		return err_report(ERR_INPUT, r->path, "its index refers to a place that does not exist");
	r->p = r->piece + (place->offset - r->piece_start);
	r->next_number = place->number;
	return 0;
}

/* ---- opening ---- */

static int read_header(struct trace_reader *r)
{
	uint64_t semantic = 0;

	r->version = (unsigned)reader_uint(r);
	if (r->status == 0 && r->version > TRACE_VERSION)
		return err_report(ERR_INPUT, r->path, "not a trace, or one of format %u, which is newer than %u", r->version,
		                  (unsigned)TRACE_VERSION);
	if (r->version >= 6)
		semantic = reader_uint(r);
	if (r->status == 0 && semantic > r->version)
		return err_report(ERR_INPUT, r->path, "not a trace: its header is invalid");
	while (r->version >= 6 && r->status == 0) {
		const char *name = reader_string(r, &r->sigs, NULL), *value;
		if (!name || !*name)
			break;
		value = reader_string(r, &r->sigs, NULL);
		if (value && r->n_properties < READER_MAX_PROPERTIES) {
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

int trace_reader_open(struct trace_reader **out, const char *path, trace_find *find)
{
	struct trace_reader *r = calloc(1, sizeof(*r));
	int rc = ERR_SYSTEM;

	*out = NULL;
	if (!r || !(r->path = strdup(path))) {
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	r->find = find;
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
	for (unsigned kind = 0; kind < N_TRACE_SIG_KINDS; kind++)
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

uint64_t trace_reader_cut_after(const struct trace_reader *r)
{
	return r->cut ? r->next_number : 0;
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

uint64_t trace_reader_behind(const struct trace_reader *r)
{
	return container_behind(r->container);
}

uint64_t trace_reader_size(const struct trace_reader *r)
{
	return container_size(r->container);
}

const char *trace_enum_name(const struct trace_value *v)
{
	const struct trace_values_sig *sig = v->type == TRACE_ENUM ? v->sig : NULL;

	for (uint32_t i = 0; sig && i < sig->n; i++)
		if ((int64_t)sig->values[i] == v->i)
			return sig->names[i];
	return NULL;
}
