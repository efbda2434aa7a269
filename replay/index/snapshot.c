#include "replay/index/snapshot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "layout.h"
#include "base/err.h"
#include "capture/format/trace.h"
#include "replay/build/mesh.h"
#include "replay/gl/geometry/array.h"
#include "replay/gl/geometry/buffer.h"
#include "replay/gl/geometry/eval.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/vertexarray.h"
#include "replay/gl/state/attrib.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "base/bytes.h"
#include "base/arena.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "base/table.h"

#define MAX_VALUE_DEPTH 17
#define MAX_OBJECTS (1u << 24)

/*
 * Structs with pointers. Who adds a plain field only writes the new size here; who adds a pointer, a table or a handle says
 * below what becomes of it. (The groups of struct gls_attribs hold no pointers and may grow as they like.)
 */
#define KNOWN(type, size) \
	_Static_assert(sizeof(type) == (size), #type " has changed: see what becomes of it in replay/index/snapshot.c")

/* --- Saving -------------------------------------------------------------------------------------------------------- */

struct saver {
	struct gls_exec *x;
	const struct snapshot_blobs *blobs;
	struct bytes *out;
	uint64_t held; /* bytes of all blobs so far */
	int err;
	size_t wanted; /* snapshot_place: the byte that is asked about, SIZE_MAX else */
	char place[96];
};

/* What comes next; so that a byte of the whole can be named. */
static void section(struct saver *s, const char *what, uint64_t number)
{
	if (s->out->n <= s->wanted && s->wanted != SIZE_MAX)
		snprintf(s->place, sizeof(s->place), "%s %llu, byte %zu", what, (unsigned long long)number,
		         s->wanted - s->out->n);
}

static void find_name(const void *data, size_t n, uint64_t name[2])
{
	XXH128_hash_t hash = XXH3_128bits(data, n);

	name[0] = hash.low64;
	name[1] = hash.high64;
}

static void put_named_blob(struct saver *s, const uint64_t name[2], const void *data, size_t n)
{
	if (s->blobs->count) {
		*s->blobs->count += n;
		return;
	}
	bytes_put_u64(s->out, n);
	bytes_put(s->out, name, 16);
	s->held += n;
	if (n && !s->err)
		s->err = s->blobs->put(s->blobs->user, name, data, n);
}

static void put_blob(struct saver *s, const void *data, size_t n)
{
	uint64_t name[2] = { 0 };

	if (!s->blobs->count)
		find_name(data, n, name);
	put_named_blob(s, name, data, n);
}

static int by_key(const void *a, const void *b)
{
	const struct table_entry *l = a, *r = b;

	return (l->key > r->key) - (l->key < r->key);
}

/* Entries of a table in ascending order of their keys, so that equal tables are equal bytes. */
static struct table_entry *sorted(struct saver *s, const struct table *t)
{
	struct table_entry *entries = malloc((t->n + 1) * sizeof(*entries));
	size_t n = 0;

	if (!entries) {
		s->err = err_report(ERR_SYSTEM, s->x->path, "out of memory");
		bytes_put_u64(s->out, 0);
		return NULL;
	}
	for (size_t i = 0; i < t->room; i++)
		if (t->entries[i].value)
			entries[n++] = t->entries[i];
	qsort(entries, n, sizeof(*entries), by_key);
	bytes_put_u64(s->out, n);
	return entries;
}

#define N_MESH_POINTERS (6 + SCENE_MAX_UNITS + 3)

/* Meshes: one block of memory, its pointers as distances from its begin, 0 for NULL. */
static void mesh_pointers(struct scene_mesh *m, const void **out[N_MESH_POINTERS])
{
	unsigned n = 0;

	out[n++] = (const void **)&m->position;
	out[n++] = (const void **)&m->normal;
	out[n++] = (const void **)&m->color;
	out[n++] = (const void **)&m->secondary;
	out[n++] = (const void **)&m->fog_coord;
	out[n++] = (const void **)&m->face;
	for (unsigned u = 0; u < SCENE_MAX_UNITS; u++)
		out[n++] = (const void **)&m->texcoord[u];
	out[n++] = (const void **)&m->index;
	out[n++] = (const void **)&m->primitive_draw;
	out[n++] = (const void **)&m->edge_flags;
}

static void put_mesh(struct saver *s, const struct gls_mesh *mesh)
{
	struct gls_mesh *copy = malloc(mesh->bytes);
	const void **pointers[N_MESH_POINTERS];

	KNOWN(struct gls_mesh, 216);
	if (!copy) {
		s->err = err_report(ERR_SYSTEM, s->x->path, "out of memory");
		return;
	}
	memcpy((void *)copy, mesh, mesh->bytes);
	atomic_init(&copy->refs, 0);
	copy->used_frame = copy->slot_frame = 0;
	copy->slot = 0;
	mesh_pointers(&copy->mesh, pointers);
	for (unsigned i = 0; i < N_MESH_POINTERS; i++)
		if (*pointers[i])
			*pointers[i] = (const void *)((uintptr_t)*pointers[i] - (uintptr_t)mesh);
	put_blob(s, copy, mesh->bytes);
	free(copy);
}

static void put_value(struct bytes *b, const struct trace_value *v)
{
	bytes_put_u64(b, (uint64_t)(int64_t)v->type);
	bytes_put_u64(b, v->count);
	switch (v->type) {
	case TRACE_STRING:
	case TRACE_BLOB:
		bytes_put(b, v->blob, v->count);
		break;
	case TRACE_ARRAY:
	case TRACE_STRUCT:
	case TRACE_REPR:
		for (uint64_t i = 0; i < v->count; i++)
			put_value(b, &v->items[i]);
		break;
	default:
		bytes_put_u64(b, v->u);
	}
}

static void put_values4(struct bytes *b, uint32_t mask, const float (*values)[4])
{
	bytes_put_u64(b, mask);
	bytes_put(b, values, (size_t)__builtin_popcount(mask) * 16);
}

static void put_op(struct saver *s, const struct gls_op *op)
{
	bytes_put_u64(s->out, op->form);
	bytes_put_u64(s->out, op->command);
	bytes_put_u64(s->out, op->n);
	if (op->form == GLS_OP_CALL) {
		for (uint32_t i = 0; i < op->n; i++)
			put_value(s->out, &op->args[i]);
		bytes_put_u64(s->out, op->unpack != NULL);
		if (op->unpack)
			bytes_put(s->out, op->unpack, sizeof(*op->unpack));
	} else if (op->form == GLS_OP_MESH) {
		put_values4(s->out, op->mesh->before, op->mesh->before_values);
		put_values4(s->out, op->mesh->after, op->mesh->after_values);
		bytes_put_u64(s->out, (uint64_t)op->mesh->first_provokes << 32 | op->mesh->n_draws);
		bytes_put_u64(s->out, op->mesh->mesh != NULL);
		if (op->mesh->mesh)
			put_mesh(s, op->mesh->mesh);
	} else {
		bytes_put(s->out, op->floats, op->n * sizeof(float));
	}
}

/* A list is a blob of its own: most lists are the same at every checkpoint, and none changes once it is whole. */
static void put_list(struct saver *s, struct gls_list *list)
{
	struct bytes own = { .n = 0 }, *out = s->out;
	uint64_t before = s->held;

	if (list->held && (s->blobs->count || (s->blobs->have && s->blobs->have(s->blobs->user, list->name)))) {
		if (s->blobs->count)
			*s->blobs->count += list->held;
		s->held += list->held;
		bytes_put_u64(s->out, list->bytes);
		bytes_put(s->out, list->name, sizeof(list->name));
		return;
	}
	s->out = &own;
	bytes_put_u64(&own, list->n);
	for (uint32_t i = 0; i < list->n; i++)
		put_op(s, &list->ops[i]);
	s->out = out;
	if (own.failed && !s->err)
		s->err = err_report(ERR_SYSTEM, s->x->path, "out of memory");
	if (!s->blobs->count)
		find_name(own.data, own.n, list->name);
	put_named_blob(s, list->name, own.data, own.n);
	if (!s->blobs->count && !s->err) {
		list->bytes = own.n;
		list->held = s->held - before;
	}
	free(own.data);
}

/* What of a texture is not levels: before them and behind them. */
#define LEVELS_BEGIN offsetof(struct gls_texture, levels)
#define LEVELS_END (LEVELS_BEGIN + sizeof(((struct gls_texture *)0)->levels))

/* Levels that are there, each after its number. Most are the same at every checkpoint: their names are found once. */
static void put_texture(struct saver *s, struct gls_texture *t)
{
	static const struct gls_level none;
	struct gls_texture raw;

	memcpy(&raw, t, LEVELS_BEGIN);
	memcpy((char *)&raw + LEVELS_END, (const char *)t + LEVELS_END, sizeof(raw) - LEVELS_END);
	raw.image = NULL;
	raw.dirty = 1;
	raw.hashed = 0;
	bytes_put(s->out, &raw, LEVELS_BEGIN);
	bytes_put(s->out, (const char *)&raw + LEVELS_END, sizeof(raw) - LEVELS_END);
	for (unsigned i = 0; i < 6 * GLS_MAX_LEVELS; i++) {
		struct gls_level *level = &t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS], kept;
		if (memcmp(level, &none, sizeof(none)) == 0)
			continue;
		kept = *level;
		kept.texels = NULL;
		memset(kept.hash, 0, sizeof(kept.hash));
		bytes_put_u64(s->out, i);
		bytes_put(s->out, &kept, sizeof(kept));
		bytes_put_u64(s->out, level->texels != NULL);
		if (level->texels && !t->hashed && !s->blobs->count)
			find_name(level->texels, level->bytes, level->hash);
		if (level->texels)
			put_named_blob(s, level->hash, level->texels, level->bytes);
	}
	bytes_put_u64(s->out, UINT64_MAX);
	t->hashed |= !s->blobs->count;
}

static void put_share(struct saver *s, const struct gls_share *share)
{
	struct table_entry *e;
	size_t n;

	e = sorted(s, &share->lists);
	n = e ? share->lists.n : 0;
	for (size_t i = 0; i < n; i++) {
		section(s, "list", e[i].key);
		bytes_put_u64(s->out, e[i].key);
		put_list(s, e[i].value);
	}
	free(e);
	e = sorted(s, &share->textures);
	n = e ? share->textures.n : 0;
	for (size_t i = 0; i < n; i++) {
		section(s, "texture", e[i].key);
		bytes_put_u64(s->out, e[i].key);
		put_texture(s, e[i].value);
	}
	free(e);
	e = sorted(s, &share->buffers);
	n = e ? share->buffers.n : 0;
	for (size_t i = 0; i < n; i++) {
		struct gls_buffer raw = *(const struct gls_buffer *)e[i].value;
		const void *data = raw.data;
		raw.data = NULL;
		section(s, "buffer", e[i].key);
		bytes_put_u64(s->out, e[i].key);
		bytes_put(s->out, &raw, sizeof(raw));
		put_blob(s, data, data ? raw.bytes : 0);
	}
	free(e);
	e = sorted(s, &share->programs);
	n = e ? share->programs.n : 0;
	for (size_t i = 0; i < n; i++) {
		bytes_put_u64(s->out, e[i].key);
		bytes_put_u64(s->out, (uintptr_t)e[i].value);
	}
	free(e);
	e = sorted(s, &share->framebuffers);
	n = e ? share->framebuffers.n : 0;
	for (size_t i = 0; i < n; i++) {
		struct gls_framebuffer raw = *(const struct gls_framebuffer *)e[i].value;
		memset(&raw.surface, 0, sizeof(raw.surface)); /* what was drawn is missing: gls_framebuffer_touch */
		raw.read = NULL;
		section(s, "framebuffer object", e[i].key);
		bytes_put_u64(s->out, e[i].key);
		bytes_put(s->out, &raw, sizeof(raw));
	}
	free(e);
	e = sorted(s, &share->renderbuffers);
	n = e ? share->renderbuffers.n : 0;
	for (size_t i = 0; i < n; i++) {
		struct gls_renderbuffer raw = *(const struct gls_renderbuffer *)e[i].value;
		raw.content = NULL;
		section(s, "renderbuffer", e[i].key);
		bytes_put_u64(s->out, e[i].key);
		bytes_put(s->out, &raw, sizeof(raw));
	}
	free(e);
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++) {
		bytes_put_u64(s->out, share->defaults[i] != NULL);
		if (share->defaults[i])
			put_texture(s, share->defaults[i]);
	}
}

/* Of all arrays. */
static void put_array_memory(struct saver *s, const struct gls_array *arrays)
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++)
		put_blob(s, arrays[i].client, arrays[i].client ? arrays[i].client_bytes : 0);
}

static void put_vertex_arrays(struct saver *s, const struct gls_state *st)
{
	struct table_entry *e = sorted(s, &st->vertex_arrays);
	size_t n = e ? st->vertex_arrays.n : 0;

	for (size_t i = 0; i < n; i++) {
		const struct gls_vertex_array *object = e[i].value;
		struct gls_vertex_array raw = *object;

		for (unsigned k = 0; k < N_GLS_ARRAYS; k++) {
			raw.arrays[k].client = NULL;
			raw.arrays[k].client_room = 0;
		}
		bytes_put_u64(s->out, e[i].key);
		bytes_put(s->out, &raw, sizeof(raw));
		put_array_memory(s, object->arrays);
	}
	free(e);
}

/* Client memory apart, which belongs to the arrays in use and not to those on the stack. */
static struct gls_client_attribs without_memory(const struct gls_client_attribs *client)
{
	struct gls_client_attribs raw = *client;

	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		raw.arrays[i].client = NULL;
		raw.arrays[i].client_room = 0;
	}
	return raw;
}

static uint64_t context_of(const struct gls_exec *x, const struct gls_state *st)
{
	uint64_t i = 0;

	while (&x->contexts[i]->state != st)
		i++;
	return i;
}

/* What was pushed once, and is not read again: it differs with what was left out of lists that drew nothing (effect.c). */
static void clear_unused(struct gls_matrix_stack *stack)
{
	memset(stack->matrices[stack->depth + 1], 0, (GLS_MAX_MATRICES - 1 - stack->depth) * sizeof(stack->matrices[0]));
}

static void put_state(struct saver *s, const struct gls_state *st)
{
	struct gls_state raw = *st;

	raw.client = without_memory(&st->client);
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
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		clear_unused(&raw.texture[u]);
	section(s, "struct gls_state of context", context_of(s->x, st));
	bytes_put(s->out, &raw, sizeof(raw));
	section(s, "array memory of context", context_of(s->x, st));
	put_array_memory(s, st->client.arrays);
	section(s, "vertex array objects of context", context_of(s->x, st));
	put_vertex_arrays(s, st);
	section(s, "attribute stacks of context", context_of(s->x, st));
	bytes_put(s->out, st->attrib_stack, st->attrib_depth * sizeof(*st->attrib_stack));
	for (unsigned i = 0; i < st->client_depth; i++) {
		struct gls_saved_client saved = st->client_stack[i];
		saved.client = without_memory(&st->client_stack[i].client);
		bytes_put(s->out, &saved, sizeof(saved));
	}
	section(s, "evaluators' maps of context", context_of(s->x, st));
	gls_maps_save(st->maps, s->out);
}

/* Place of a context among all, from 1; 0: none. */
static uint64_t context_number(const struct gls_exec *x, const struct gls_context *ctx)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i] == ctx)
			return i + 1;
	return 0;
}

/* The first context of a share group stands for it. */
static uint64_t share_number(const struct gls_exec *x, const struct gls_share *share)
{
	uint64_t i = 0;

	while (x->contexts[i]->state.share != share)
		i++;
	return i;
}

static int is_quiet(const struct gls_exec *x)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i]->state.list || x->contexts[i]->state.begin_mode)
			return 0;
	return x->pending.geometry.n_vertices == 0;
}

static int save(struct saver *s)
{
	struct gls_exec *x = s->x;
	struct bytes *out = s->out;
	struct table_entry *e;
	size_t n;

	KNOWN(struct gls_exec, 1256);
	if (!is_quiet(x))
		return 1;
	bytes_put_u64(out, x->frame);
	bytes_put_u64(out, x->n_calls);
	bytes_put_u64(out, x->caches.versions);
	bytes_put_u64(out, x->thread);
	bytes_put_u64(out, (uint64_t)x->feedback.missing);
	bytes_put_u64(out, x->n_contexts);
	for (size_t i = 0; i < x->n_contexts; i++) {
		const struct gls_context *ctx = x->contexts[i];
		uint64_t share = share_number(x, ctx->state.share);
		_Static_assert(sizeof(struct gls_context) - sizeof(struct gls_state) == 40,
		               "struct gls_context has changed: see what becomes of it in replay/index/snapshot.c");
		section(s, "context", i);
		bytes_put_u64(out, ctx->handle);
		bytes_put_u64(out, ctx->share_handle);
		bytes_put_text(out, ctx->api);
		bytes_put_u64(out, ctx->calls);
		bytes_put_u64(out, (uint64_t)ctx->destroyed);
		bytes_put_u64(out, (uint64_t)ctx->shares);
		bytes_put_u64(out, share);
		if (share == i)
			put_share(s, ctx->state.share);
		put_state(s, &ctx->state);
	}
	section(s, "threads", x->n_threads);
	bytes_put_u64(out, x->n_threads);
	for (size_t i = 0; i < x->n_threads; i++)
		bytes_put_u64(out, context_number(x, x->threads[i]));
	section(s, "drawables", x->drawables.n);
	e = sorted(s, &x->drawables);
	n = e ? x->drawables.n : 0;
	for (size_t i = 0; i < n; i++) {
		const struct gls_drawable *d = e[i].value;
		KNOWN(struct gls_drawable, 192);
		bytes_put_u64(out, e[i].key);
		bytes_put_u64(out, d->width);
		bytes_put_u64(out, d->height);
		bytes_put_u64(out, (uint64_t)d->fixed);
		bytes_put_u64(out, d->accum_missing || d->accum);
	}
	free(e);
	section(s, "configurations", x->configs.n);
	e = sorted(s, &x->configs);
	n = e ? x->configs.n : 0;
	for (size_t i = 0; i < n; i++) {
		bytes_put_u64(out, e[i].key);
		bytes_put_u64(out, (uintptr_t)e[i].value);
	}
	free(e);
	if (out->failed && !s->err)
		s->err = err_report(ERR_SYSTEM, x->path, "out of memory");
	return s->err;
}

int snapshot_save(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out)
{
	struct saver s = { .x = x, .blobs = blobs, .out = out, .wanted = SIZE_MAX };

	return save(&s);
}

static int keep_nothing(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

const char *snapshot_place(struct gls_exec *x, size_t at)
{
	static _Thread_local char place[96];
	const struct snapshot_blobs nowhere = { .put = keep_nothing };
	struct bytes out = { .n = 0 };
	struct saver s = { .x = x, .blobs = &nowhere, .out = &out, .wanted = at, .place = "head" };

	save(&s);
	free(out.data);
	memcpy(place, s.place, sizeof(place));
	return place;
}

/* --- Loading ------------------------------------------------------------------------------------------------------- */

struct loader {
	struct gls_exec *x;
	const struct snapshot_blobs *blobs;
	struct cursor in;
	int err; /* ERR_SYSTEM: no memory (reported) */
};

static int is_bad(const struct loader *l)
{
	return l->in.failed || l->err;
}

static void *allocate(struct loader *l, size_t n)
{
	void *out = is_bad(l) ? NULL : calloc(1, n ? n : 1);

	if (!out && !is_bad(l))
		l->err = err_report(ERR_SYSTEM, l->x->path, "out of memory");
	return out;
}

/* A count of things of so many bytes each at least: no more than there can be. */
static uint64_t get_count(struct loader *l, size_t bytes)
{
	uint64_t n = cursor_u64(&l->in);

	if (n > MAX_OBJECTS || n * bytes > (uint64_t)(l->in.end - l->in.p))
		l->in.failed = 1;
	return l->in.failed ? 0 : n;
}

/* @return its bytes (NULL where there are none); *n receives how many */
static uint8_t *get_blob(struct loader *l, size_t *n)
{
	uint64_t size = cursor_u64(&l->in), name[2];
	uint8_t *data;

	*n = 0;
	cursor_copy(&l->in, name, sizeof(name));
	if (is_bad(l) || size == 0)
		return NULL;
	data = size < (uint64_t)1 << 40 ? l->blobs->get(l->blobs->user, name, (size_t)size) : NULL;
	if (data)
		*n = (size_t)size;
	else
		l->in.failed = 1;
	return data;
}

/* The bytes that each array of a mesh needs at least; order as mesh_pointers. */
static void mesh_needs(const struct scene_mesh *m, size_t out[N_MESH_POINTERS])
{
	static const unsigned floats[] = { 4, 3, 4, 4, 1, sizeof(*m->face) / 4 };
	size_t n = m->vertex_count, p = m->primitive_count;
	unsigned i = 0;

	for (; i < 6; i++)
		out[i] = n * floats[i] * sizeof(float);
	for (; i < 6 + SCENE_MAX_UNITS; i++)
		out[i] = n * 4 * sizeof(float);
	out[i++] = p * m->kind * sizeof(uint32_t);
	out[i++] = p * sizeof(uint32_t);
	out[i++] = p;
}

/* Distances become pointers again. @return 0 where one leads out of the block */
static int relocate(struct gls_mesh *mesh, size_t n)
{
	const void **pointers[N_MESH_POINTERS];
	size_t needs[N_MESH_POINTERS];
	struct scene_mesh *m = &mesh->mesh;

	if (mesh->bytes != n || (m->kind != SCENE_TRIANGLES && m->kind != SCENE_LINES && m->kind != SCENE_POINTS))
		return 0;
	mesh_pointers(m, pointers);
	mesh_needs(m, needs);
	for (unsigned i = 0; i < N_MESH_POINTERS; i++) {
		uintptr_t distance = (uintptr_t)*pointers[i];
		if (distance == 0)
			continue;
		if (distance < sizeof(*mesh) || distance > n || needs[i] > n - distance ||
		    (distance % 4 && i + 1 < N_MESH_POINTERS))
			return 0;
		*pointers[i] = (const char *)mesh + distance;
	}
	if (!m->position || !m->index)
		return 0;
	for (size_t i = 0; i < (size_t)m->primitive_count * m->kind; i++)
		if (m->index[i] >= m->vertex_count)
			return 0;
	return 1;
}

/* A mesh of the cache, with a reference for the caller. */
static struct gls_mesh *get_mesh(struct loader *l)
{
	struct gls_mesh *mesh, *known;
	uint64_t key;
	size_t n;
	uint8_t *data = get_blob(l, &n);

	if (!data)
		return NULL;
	mesh = n >= sizeof(*mesh) && n % 64 == 0 ? aligned_alloc(64, n) : NULL;
	if (mesh)
		memcpy((void *)mesh, data, n);
	free(data);
	if (!mesh || !relocate(mesh, n)) {
		free(mesh);
		l->in.failed = 1;
		return NULL;
	}
	for (key = mesh->mesh.hash[0]; (known = table_find(&l->x->caches.meshes, key)); key++)
		if (memcmp(known->mesh.hash, mesh->mesh.hash, sizeof(mesh->mesh.hash)) == 0)
			break;
	if (known) {
		free(mesh);
		atomic_fetch_add(&known->refs, 1);
		return known;
	}
	atomic_init(&mesh->refs, 2); /* the cache and the caller */
	mesh->used_frame = l->x->frame;
	mesh->slot_frame = 0;
	mesh->slot = 0;
	if (table_set(&l->x->caches.meshes, key, mesh)) {
		free(mesh);
		l->err = ERR_SYSTEM;
		return NULL;
	}
	l->x->caches.mesh_bytes += n;
	return mesh;
}

static void *take(struct loader *l, struct arena *a, size_t n)
{
	void *out = is_bad(l) ? NULL : arena_alloc(a, n ? n : 1);

	if (!out && !is_bad(l))
		l->err = err_report(ERR_SYSTEM, l->x->path, "out of memory");
	return out;
}

static void get_value(struct loader *l, struct arena *a, struct trace_value *v, unsigned depth)
{
	struct trace_value *items;
	uint8_t *bytes;
	const void *from;

	*v = (struct trace_value){ .type = (enum trace_type)(int64_t)cursor_u64(&l->in) };
	v->count = cursor_u64(&l->in);
	switch (v->type) {
	case TRACE_STRING:
	case TRACE_BLOB:
		from = cursor_get(&l->in, v->count);
		bytes = from ? take(l, a, v->count + 1) : NULL;
		if (!bytes)
			break;
		memcpy(bytes, from, v->count);
		bytes[v->count] = 0;
		v->blob = bytes;
		return;
	case TRACE_ARRAY:
	case TRACE_STRUCT:
	case TRACE_REPR:
		if (depth == MAX_VALUE_DEPTH || v->count > (uint64_t)(l->in.end - l->in.p) / 16) {
			l->in.failed = 1;
			break;
		}
		items = take(l, a, v->count * sizeof(*items));
		for (uint64_t i = 0; i < v->count && items && !is_bad(l); i++)
			get_value(l, a, &items[i], depth + 1);
		v->items = items;
		if (items && !is_bad(l))
			return;
		break;
	default:
		v->u = cursor_u64(&l->in);
		return;
	}
	*v = (struct trace_value){ .type = TRACE_NONE };
}

static const float (*get_values4(struct loader *l, struct arena *a, uint32_t *mask))[4]
{
	float (*values)[4];

	*mask = (uint32_t)cursor_u64(&l->in);
	if (*mask >> N_GLS_ATTRIBUTES)
		l->in.failed = 1;
	values = take(l, a, (size_t)(__builtin_popcount(*mask) + 1) * sizeof(*values));
	if (values)
		cursor_copy(&l->in, values, (size_t)__builtin_popcount(*mask) * sizeof(*values));
	return (const float (*)[4])values;
}

static void get_op(struct loader *l, struct gls_list *list, struct gls_op *op)
{
	struct gls_op_mesh *kept;
	struct gls_pixel_store *unpack;
	struct trace_value *args;
	uint64_t n_draws;
	float *floats;

	op->form = (uint16_t)cursor_u64(&l->in);
	op->command = (uint16_t)cursor_u64(&l->in);
	op->n = (uint32_t)cursor_u64(&l->in);
	if (op->command >= n_gls_commands || op->form > GLS_OP_MESH || op->n > (uint64_t)(l->in.end - l->in.p) / 4 ||
	    (op->form != GLS_OP_MESH && op->form != GLS_OP_CALL && op->n > 16)) /* what unpack_call has room for */
		l->in.failed = 1;
	if (op->form == GLS_OP_CALL) {
		op->args = args = take(l, &list->arena, op->n * sizeof(*args));
		for (uint32_t i = 0; i < op->n && args && !is_bad(l); i++)
			get_value(l, &list->arena, &args[i], 0);
		if (cursor_u64(&l->in)) {
			op->unpack = unpack = take(l, &list->arena, sizeof(*unpack));
			if (unpack)
				cursor_copy(&l->in, unpack, sizeof(*unpack));
			l->in.failed |= unpack && unpack->alignment < 1; /* divided by */
		}
		return;
	}
	if (op->form != GLS_OP_MESH) {
		op->floats = floats = take(l, &list->arena, op->n * sizeof(*floats));
		if (floats)
			cursor_copy(&l->in, floats, op->n * sizeof(*floats));
		return;
	}
	op->mesh = kept = take(l, &list->arena, sizeof(*kept));
	if (!kept)
		return;
	memset(kept, 0, sizeof(*kept));
	kept->before_values = get_values4(l, &list->arena, &kept->before);
	kept->after_values = get_values4(l, &list->arena, &kept->after);
	n_draws = cursor_u64(&l->in);
	kept->n_draws = (uint32_t)n_draws;
	kept->first_provokes = n_draws >> 32 & 1;
	if (cursor_u64(&l->in))
		kept->mesh = get_mesh(l);
}

static struct gls_list *get_list(struct loader *l)
{
	size_t n_bytes;
	uint8_t *data = get_blob(l, &n_bytes);
	struct cursor outer = l->in;
	struct gls_list *list = allocate(l, sizeof(*list));
	uint64_t n;

	if (!data || !list) {
		l->in.failed |= !data;
		free(data);
		free(list);
		return NULL;
	}
	KNOWN(struct gls_list, 120);
	KNOWN(struct gls_op, 24);
	KNOWN(struct gls_pixel_store, 36);
	KNOWN(struct gls_op_mesh, 40);
	l->in = (struct cursor){ data, data + n_bytes, 0 };
	n = get_count(l, 24);
	list->ops = allocate(l, n * sizeof(*list->ops));
	list->room = list->ops ? (uint32_t)n : 0;
	for (; list->n < list->room && !is_bad(l); list->n++) {
		get_op(l, list, &list->ops[list->n]);
		if (is_bad(l) && list->ops[list->n].form == GLS_OP_MESH && !list->ops[list->n].mesh)
			list->ops[list->n].form = GLS_OP_CALL; /* nothing to free there */
	}
	outer.failed |= l->in.failed;
	l->in = outer;
	free(data);
	if (is_bad(l)) {
		gls_list_free(list);
		return NULL;
	}
	return list;
}

static struct gls_texture *get_texture(struct loader *l)
{
	struct gls_texture *t = allocate(l, sizeof(*t));

	KNOWN(struct gls_texture, 5896);
	KNOWN(struct gls_level, 64);
	if (!t)
		return NULL;
	cursor_copy(&l->in, t, LEVELS_BEGIN);
	cursor_copy(&l->in, (char *)t + LEVELS_END, sizeof(*t) - LEVELS_END);
	t->image = NULL;
	t->dirty = 1;
	t->hashed = 0;
	for (uint64_t i; !is_bad(l) && (i = cursor_u64(&l->in)) != UINT64_MAX;) {
		struct gls_level *level;
		size_t n;
		if (i >= 6 * GLS_MAX_LEVELS || t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS].texels) {
			l->in.failed = 1;
			break;
		}
		level = &t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS];
		cursor_copy(&l->in, level, sizeof(*level));
		level->texels = NULL;
		if (!cursor_u64(&l->in))
			continue;
		level->texels = get_blob(l, &n);
		level->texel_bytes = gls_texel_bytes(level->internal_format);
		if (n != level->bytes || level->width > 65536 || level->height > 65536 || level->depth > 65536 ||
		    (uint64_t)level->width * level->height * level->depth > n / level->texel_bytes)
			l->in.failed = 1;
	}
	if (!is_bad(l) && t->target <= N_GLS_TEXTURE_TARGETS)
		return t;
	l->in.failed = 1;
	gls_texture_free(t);
	return NULL;
}

static struct gls_buffer *get_buffer(struct loader *l)
{
	struct gls_buffer *b = allocate(l, sizeof(*b));
	uint8_t *data;
	size_t n;

	KNOWN(struct gls_buffer, 48);
	if (!b)
		return NULL;
	cursor_copy(&l->in, b, sizeof(*b));
	b->data = NULL;
	data = get_blob(l, &n);
	if (n != b->bytes && !(n == 0 && b->bytes == 0))
		l->in.failed = 1;
	b->data = allocate(l, b->bytes + 1);
	if (b->data && data)
		memcpy(b->data, data, n);
	free(data);
	if (!is_bad(l) && b->mapped && table_set(&l->x->maps, b->mapped, b))
		l->err = ERR_SYSTEM;
	if (!is_bad(l))
		return b;
	free(b->data);
	free(b);
	return NULL;
}

static void keep(struct loader *l, struct table *t, uint64_t key, void *value)
{
	if (value && table_set(t, key, value))
		l->err = ERR_SYSTEM; /* the value is lost to the end of the process: there is no memory left anyway */
}

static struct gls_framebuffer *get_framebuffer(struct loader *l)
{
	struct gls_framebuffer *fb = allocate(l, sizeof(*fb));

	if (!fb)
		return NULL;
	cursor_copy(&l->in, fb, sizeof(*fb));
	memset(&fb->surface, 0, sizeof(fb->surface));
	fb->read = NULL;
	for (unsigned i = 0; i < N_GLS_ATTACHMENTS; i++)
		if (fb->attached[i].face >= 6 || fb->attached[i].level >= GLS_MAX_LEVELS)
			l->in.failed = 1;
	return fb;
}

static void get_share(struct loader *l, struct gls_share *share)
{
	uint64_t n, key;

	KNOWN(struct gls_share, 200);
	KNOWN(struct gls_framebuffer, 304);
	n = get_count(l, 32);
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		key = cursor_u64(&l->in);
		keep(l, &share->lists, key, get_list(l));
	}
	n = get_count(l, sizeof(struct gls_texture) - sizeof(((struct gls_texture *)0)->levels));
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		key = cursor_u64(&l->in);
		keep(l, &share->textures, key, get_texture(l));
	}
	n = get_count(l, sizeof(struct gls_buffer));
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		key = cursor_u64(&l->in);
		keep(l, &share->buffers, key, get_buffer(l));
	}
	n = get_count(l, 16);
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		key = cursor_u64(&l->in);
		keep(l, &share->programs, key, (void *)(uintptr_t)cursor_u64(&l->in));
	}
	n = get_count(l, sizeof(struct gls_framebuffer));
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		key = cursor_u64(&l->in);
		keep(l, &share->framebuffers, key, get_framebuffer(l));
	}
	n = get_count(l, sizeof(struct gls_renderbuffer));
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		struct gls_renderbuffer *r = allocate(l, sizeof(*r));
		key = cursor_u64(&l->in);
		if (!r)
			break;
		cursor_copy(&l->in, r, sizeof(*r));
		r->content = NULL;
		if (r->width > 16384 || r->height > 16384)
			l->in.failed = 1;
		keep(l, &share->renderbuffers, key, r);
	}
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS && !is_bad(l); i++)
		if (cursor_u64(&l->in))
			share->defaults[i] = get_texture(l);
}

static int depth_fits(const struct gls_matrix_stack *loaded, const struct gls_matrix_stack *made)
{
	return loaded->max == made->max && loaded->depth < made->max;
}

/* Numbers that are used as places in arrays. */
static int state_fits(const struct gls_state *raw, const struct gls_state *made)
{
	int fits = depth_fits(&raw->modelview, &made->modelview) && depth_fits(&raw->projection, &made->projection) &&
	           depth_fits(&raw->color_matrix, &made->color_matrix);

	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		fits &= depth_fits(&raw->texture[u], &made->texture[u]);
	for (unsigned i = 0; i < N_GLS_PIXEL_MAPS; i++)
		fits &= raw->pixel_maps[i].size <= GLS_MAX_PIXEL_MAP;
	return fits && raw->attrib_depth <= GLS_MAX_ATTRIB_DEPTH && raw->client_depth <= GLS_MAX_ATTRIB_DEPTH &&
	       raw->a.texturing.active < GLS_MAX_UNITS && raw->client.active_texture < GLS_MAX_UNITS && !raw->begin_mode;
}

/* The pointers among what was read are none until their bytes are. */
static void get_array_memory(struct loader *l, struct gls_array *arrays)
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		size_t n;

		arrays[i].client = is_bad(l) ? NULL : get_blob(l, &n);
		arrays[i].client_room = arrays[i].client ? n : 0;
		if (!is_bad(l) && arrays[i].client_room != arrays[i].client_bytes)
			l->in.failed = 1;
	}
}

static void get_vertex_arrays(struct loader *l, struct gls_state *st)
{
	uint64_t n = get_count(l, sizeof(struct gls_vertex_array));

	KNOWN(struct gls_vertex_array, 1088);
	for (uint64_t i = 0; i < n && !is_bad(l); i++) {
		struct gls_vertex_array *object = allocate(l, sizeof(*object));
		uint64_t name = cursor_u64(&l->in);

		if (!object)
			return;
		cursor_copy(&l->in, object, sizeof(*object));
		get_array_memory(l, object->arrays);
		if (is_bad(l) || table_find(&st->vertex_arrays, name)) {
			l->in.failed = 1;
			gls_vertex_array_free(object);
		} else {
			keep(l, &st->vertex_arrays, name, object);
		}
	}
}

static void get_state(struct loader *l, struct gls_state *st)
{
	struct gls_state raw;

	_Static_assert(sizeof(struct gls_state) - sizeof(struct gls_attribs) == 34348,
	               "struct gls_state has changed: see what becomes of it in replay/index/snapshot.c");
	KNOWN(struct gls_array, 72);
	cursor_copy(&l->in, &raw, sizeof(raw));
	if (is_bad(l) || !state_fits(&raw, st)) {
		l->in.failed = 1;
		return;
	}
	raw.client = without_memory(&raw.client);
	raw.attrib_stack = st->attrib_stack;
	raw.client_stack = st->client_stack;
	raw.share = st->share;
	raw.list = NULL;
	raw.maps = NULL;
	memset(&raw.vertex_arrays, 0, sizeof(raw.vertex_arrays));
	raw.dirty = GLS_DIRTY_ALL;
	*st = raw;
	get_array_memory(l, st->client.arrays);
	get_vertex_arrays(l, st);
	cursor_copy(&l->in, st->attrib_stack, st->attrib_depth * sizeof(*st->attrib_stack));
	cursor_copy(&l->in, st->client_stack, st->client_depth * sizeof(*st->client_stack));
	for (unsigned i = 0; i < st->attrib_depth; i++)
		if (st->attrib_stack[i].attribs.texturing.active >= GLS_MAX_UNITS)
			l->in.failed = 1;
	for (unsigned i = 0; i < st->client_depth; i++) {
		st->client_stack[i].client = without_memory(&st->client_stack[i].client);
		if (st->client_stack[i].client.active_texture >= GLS_MAX_UNITS)
			l->in.failed = 1;
	}
	st->maps = gls_maps_load(&l->in);
}

/* The window system's name: contexts keep static strings. */
static const char *get_api(struct loader *l)
{
	static const char *const names[] = { "GLX", "EGL", "WGL", "CGL", "OSMesa" };
	uint64_t n = cursor_u64(&l->in);
	const char *text = n < 16 ? cursor_get(&l->in, n + 1) : NULL;

	for (size_t i = 0; text && text[n] == 0 && i < sizeof(names) / sizeof(names[0]); i++)
		if (strcmp(names[i], text) == 0)
			return names[i];
	l->in.failed = 1;
	return "";
}

static void get_context(struct loader *l)
{
	struct gls_exec *x = l->x;
	struct gls_context *ctx = allocate(l, sizeof(*ctx));
	uint64_t share;

	if (!ctx)
		return;
	if (gls_state_init(&ctx->state)) {
		free(ctx);
		l->err = ERR_SYSTEM;
		return;
	}
	ctx->handle = cursor_u64(&l->in);
	ctx->share_handle = cursor_u64(&l->in);
	ctx->api = get_api(l);
	ctx->calls = cursor_u64(&l->in);
	ctx->destroyed = (int)cursor_u64(&l->in);
	ctx->shares = (int)cursor_u64(&l->in);
	share = cursor_u64(&l->in);
	if (share > x->n_contexts)
		l->in.failed = 1;
	if (is_bad(l))
		share = x->n_contexts; /* so that there is one to be released */
	if (share < x->n_contexts) {
		ctx->state.share = x->contexts[share]->state.share;
		ctx->state.share->refs++;
	} else {
		ctx->state.share = gls_share_create();
		if (!ctx->state.share) {
			gls_state_free(&ctx->state);
			free(ctx);
			l->err = err_report(ERR_SYSTEM, x->path, "out of memory");
			return;
		}
	}
	x->contexts[x->n_contexts++] = ctx;
	if (share + 1 == x->n_contexts)
		get_share(l, ctx->state.share);
	get_state(l, &ctx->state);
}

static void get_threads(struct loader *l)
{
	struct gls_exec *x = l->x;
	uint64_t n = get_count(l, 8);

	x->threads = allocate(l, (n + 1) * sizeof(*x->threads));
	x->n_threads = x->threads ? (size_t)n : 0;
	for (size_t i = 0; i < x->n_threads; i++) {
		uint64_t number = cursor_u64(&l->in);
		if (number > x->n_contexts)
			l->in.failed = 1;
		else
			x->threads[i] = number ? x->contexts[number - 1] : NULL;
	}
	x->current = x->thread < x->n_threads ? x->threads[x->thread] : NULL;
	x->st = x->current ? &x->current->state : NULL;
}

int snapshot_load(struct gls_exec *x, const struct snapshot_blobs *blobs, const uint8_t *data, size_t n)
{
	struct loader l = { x, blobs, { data, data + n, 0 }, 0 };
	uint64_t count;

	x->frame = cursor_u64(&l.in);
	x->n_calls = cursor_u64(&l.in);
	x->caches.versions = cursor_u64(&l.in);
	x->thread = cursor_u64(&l.in);
	x->feedback.missing = cursor_u64(&l.in) != 0;
	count = get_count(&l, sizeof(struct gls_state));
	free(x->contexts);
	x->contexts = allocate(&l, (count + 1) * sizeof(*x->contexts));
	for (uint64_t i = 0; i < count && !is_bad(&l); i++)
		get_context(&l);
	if (!is_bad(&l))
		get_threads(&l);
	count = get_count(&l, 40);
	for (uint64_t i = 0; i < count && !is_bad(&l); i++) {
		struct gls_drawable *d = allocate(&l, sizeof(*d));
		uint64_t key = cursor_u64(&l.in);
		if (!d)
			break;
		d->width = (uint32_t)cursor_u64(&l.in);
		d->height = (uint32_t)cursor_u64(&l.in);
		d->fixed = (int)cursor_u64(&l.in);
		d->accum_missing = cursor_u64(&l.in) != 0;
		d->front.is_front = 1;
		d->surface.skipped = d->front.skipped = 1; /* as after any frame that was not built: gls_frame_skip */
		keep(&l, &x->drawables, key, d);
	}
	count = get_count(&l, 16);
	for (uint64_t i = 0; i < count && !is_bad(&l); i++) {
		uint64_t key = cursor_u64(&l.in);
		keep(&l, &x->configs, key, (void *)(uintptr_t)cursor_u64(&l.in));
	}
	if (l.err)
		return l.err;
	return l.in.failed || l.in.p != l.in.end
		? err_report(ERR_INPUT, x->path, "a checkpoint of its index cannot be read") : 0;
}

uint64_t snapshot_layout(void)
{
	XXH64_hash_t hash = XXH3_64bits(SNAPSHOT_LAYOUT, strlen(SNAPSHOT_LAYOUT));

	for (unsigned i = 0; i < n_gls_commands; i++)
		hash = XXH3_64bits_withSeed(gls_commands[i].name, strlen(gls_commands[i].name), hash);
	return hash;
}
