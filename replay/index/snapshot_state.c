#include "replay/index/snapshot_state.h"

#include <stdlib.h>
#include <string.h>

#include "replay/gl/geometry/eval.h"
#include "replay/gl/geometry/vertexarray.h"

/* ---- range checks ---- */

static int store_fits(const struct gls_pixel_store *s)
{
	const int32_t counts[] = { s->row_length, s->image_height, s->skip_rows, s->skip_pixels, s->skip_images };
	int fits = s->alignment == 1 || s->alignment == 2 || s->alignment == 4 || s->alignment == 8;

	for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++)
		fits &= counts[i] >= 0 && counts[i] <= 1 << 24; /* the range that glPixelStore accepts */
	return fits;
}

static int arrays_fit(const struct gls_array *arrays)
{
	int fits = 1;

	for (unsigned i = 0; i < N_GLS_ARRAYS; i++)
		fits &= arrays[i].stride >= 0;
	return fits;
}

/* ---- vertex arrays ---- */

static void put_array_memory(struct saver *s, const struct gls_array *arrays)
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++)
		saver_blob(s, arrays[i].client, arrays[i].client ? arrays[i].client_bytes : 0);
}

/* Pointers read from the file are meaningless: each array gets its bytes, or none. */
static void get_array_memory(struct loader *l, struct gls_array *arrays)
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		size_t n;

		arrays[i].client = loader_is_bad(l) ? NULL : loader_blob(l, &n);
		arrays[i].client_room = arrays[i].client ? n : 0;
		if (!loader_is_bad(l) && arrays[i].client_room != arrays[i].client_bytes)
			l->in.failed = 1;
	}
}

/* Clear pointers to client memory: it belongs to the arrays in use and not to those on a stack. */
static void forget_memory(struct gls_array *arrays)
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		arrays[i].client = NULL;
		arrays[i].client_room = 0;
	}
}

static void put_vertex_array(struct saver *s, void *value)
{
	const struct gls_vertex_array *object = value;
	struct gls_vertex_array raw = *object;

	forget_memory(raw.arrays);
	bytes_put(s->out, &raw, sizeof(raw));
	put_array_memory(s, object->arrays);
}

static void drop_vertex_array(void *object)
{
	gls_vertex_array_free(object);
}

static void *get_vertex_array(struct loader *l)
{
	struct gls_vertex_array *object = loader_alloc(l, sizeof(*object));

	if (!object)
		return NULL;
	cursor_copy(&l->in, object, sizeof(*object));
	l->in.failed |= !arrays_fit(object->arrays);
	get_array_memory(l, object->arrays);
	if (!loader_is_bad(l))
		return object;
	drop_vertex_array(object);
	return NULL;
}

static const struct snapshot_table vertex_arrays = {
	NULL, sizeof(struct gls_vertex_array), put_vertex_array, get_vertex_array, drop_vertex_array
};

/* ---- the state of a context ---- */

static uint64_t context_of(const struct gls_exec *x, const struct gls_state *st)
{
	uint64_t i = 0;

	while (&x->contexts[i]->state != st)
		i++;
	return i;
}

/* Matrices above the top are never read again. They differ if lists that drew nothing were cut short (effect.c). */
static void clear_unused(struct gls_matrix_stack *stack)
{
	memset(stack->matrices[stack->depth + 1], 0, (GLS_MAX_MATRICES - 1 - stack->depth) * sizeof(stack->matrices[0]));
}

void snapshot_put_state(struct saver *s, const struct gls_state *st)
{
	struct gls_state raw = *st;

	forget_memory(raw.client.arrays);
	raw.attrib_stack = NULL;
	raw.client_stack = NULL;
	raw.share = NULL;
	raw.list = NULL;
	raw.maps = NULL;
	memset(&raw.vertex_arrays, 0, sizeof(raw.vertex_arrays));
	raw.dirty = GLS_DIRTY_ALL;
	clear_unused(&raw.modelview);
	clear_unused(&raw.projection);
	clear_unused(&raw.color_matrix);
	for (unsigned i = 0; i < GLS_MAX_PROGRAM_MATRICES; i++)
		clear_unused(&raw.program_matrix[i]);
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		clear_unused(&raw.texture[u]);
	saver_section(s, "struct gls_state of context", context_of(s->x, st));
	bytes_put(s->out, &raw, sizeof(raw));
	saver_section(s, "array memory of context", context_of(s->x, st));
	put_array_memory(s, st->client.arrays);
	saver_section(s, "vertex array objects of context", context_of(s->x, st));
	saver_table(s, &st->vertex_arrays, &vertex_arrays);
	saver_section(s, "attribute stacks of context", context_of(s->x, st));
	bytes_put(s->out, st->attrib_stack, st->attrib_depth * sizeof(*st->attrib_stack));
	for (unsigned i = 0; i < st->client_depth; i++) {
		struct gls_saved_client saved = st->client_stack[i];
		forget_memory(saved.client.arrays);
		bytes_put(s->out, &saved, sizeof(saved));
	}
	saver_section(s, "evaluators' maps of context", context_of(s->x, st));
	gls_maps_save(st->maps, s->out);
}

static int depth_fits(const struct gls_matrix_stack *loaded, const struct gls_matrix_stack *made)
{
	return loaded->max == made->max && loaded->depth < made->max;
}

/* Client state, current or on the stack: check array indices, divisors and sizes. */
static int client_fits(const struct gls_client_attribs *c)
{
	return store_fits(&c->pack) && store_fits(&c->unpack) && c->active_texture < GLS_MAX_UNITS && arrays_fit(c->arrays);
}

/* Attributes, current or on the stack: check the selected unit, and each unit's own number. */
static int attribs_fit(const struct gls_attribs *a)
{
	int fits = a->texturing.active < GLS_MAX_UNITS;

	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		fits &= a->texturing.units[u].value.unit == u;
	return fits;
}

/* Check all numbers that are used as array indices. */
static int state_fits(const struct gls_state *raw, const struct gls_state *made)
{
	int fits = depth_fits(&raw->modelview, &made->modelview) && depth_fits(&raw->projection, &made->projection) &&
	           depth_fits(&raw->color_matrix, &made->color_matrix);

	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		fits &= depth_fits(&raw->texture[u], &made->texture[u]);
	for (unsigned i = 0; i < GLS_MAX_PROGRAM_MATRICES; i++)
		fits &= depth_fits(&raw->program_matrix[i], &made->program_matrix[i]);
	for (unsigned i = 0; i < N_GLS_PIXEL_MAPS; i++)
		fits &= raw->pixel_maps[i].size <= GLS_MAX_PIXEL_MAP;
	return fits && raw->attrib_depth <= GLS_MAX_ATTRIB_DEPTH && raw->client_depth <= GLS_MAX_ATTRIB_DEPTH &&
	       attribs_fit(&raw->a) && client_fits(&raw->client) && !raw->begin_mode && raw->x87 <= 1;
}

void snapshot_get_state(struct loader *l, struct gls_state *st)
{
	struct gls_state raw;

	cursor_copy(&l->in, &raw, sizeof(raw));
	if (loader_is_bad(l) || !state_fits(&raw, st)) {
		l->in.failed = 1;
		return;
	}
	forget_memory(raw.client.arrays);
	raw.attrib_stack = st->attrib_stack;
	raw.client_stack = st->client_stack;
	raw.share = st->share;
	raw.list = NULL;
	raw.maps = NULL;
	memset(&raw.vertex_arrays, 0, sizeof(raw.vertex_arrays));
	raw.dirty = GLS_DIRTY_ALL;
	*st = raw;
	get_array_memory(l, st->client.arrays);
	loader_table(l, &st->vertex_arrays, &vertex_arrays);
	cursor_copy(&l->in, st->attrib_stack, st->attrib_depth * sizeof(*st->attrib_stack));
	cursor_copy(&l->in, st->client_stack, st->client_depth * sizeof(*st->client_stack));
	for (unsigned i = 0; i < st->attrib_depth; i++)
		if (!attribs_fit(&st->attrib_stack[i].attribs))
			l->in.failed = 1;
	for (unsigned i = 0; i < st->client_depth; i++) {
		forget_memory(st->client_stack[i].client.arrays);
		if (!client_fits(&st->client_stack[i].client))
			l->in.failed = 1;
	}
	st->maps = gls_maps_load(&l->in);
}
