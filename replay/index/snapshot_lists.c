#include "replay/index/snapshot_lists.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"

#define MAX_VALUE_DEPTH 17

/* ---- meshes: one block of memory; pointers are saved as offsets from its beginning, NULL as 0 ---- */

#define N_MESH_ARRAYS (6 + SCENE_MAX_UNITS + 3)

struct mesh_array {
	const void **at;
	size_t bytes; /* at least */
};

static void mesh_arrays(struct scene_mesh *m, struct mesh_array out[N_MESH_ARRAYS])
{
	size_t n = m->vertex_count, p = m->primitive_count;
	struct mesh_array *next = out;

	*next++ = (struct mesh_array){ (const void **)&m->position, n * 4 * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->normal, n * 3 * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->color, n * 4 * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->secondary, n * 4 * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->fog_coord, n * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->face, n * sizeof(*m->face) };
	for (unsigned u = 0; u < SCENE_MAX_UNITS; u++)
		*next++ = (struct mesh_array){ (const void **)&m->texcoord[u], n * 4 * sizeof(float) };
	*next++ = (struct mesh_array){ (const void **)&m->index, p * m->kind * sizeof(uint32_t) };
	*next++ = (struct mesh_array){ (const void **)&m->primitive_draw, p * sizeof(uint32_t) };
	*next++ = (struct mesh_array){ (const void **)&m->edge_flags, p };
}

static void put_mesh(struct saver *s, const struct gls_mesh *mesh)
{
	struct gls_mesh *copy = malloc(mesh->bytes);
	struct mesh_array arrays[N_MESH_ARRAYS];

	if (!copy) {
		s->err = err_report(ERR_SYSTEM, s->x->path, "out of memory");
		return;
	}
	memcpy((void *)copy, mesh, mesh->bytes);
	atomic_init(&copy->refs, 0);
	copy->used_frame = copy->slot_frame = 0;
	copy->slot = 0;
	mesh_arrays(&copy->mesh, arrays);
	for (unsigned i = 0; i < N_MESH_ARRAYS; i++)
		if (*arrays[i].at)
			*arrays[i].at = (const void *)((uintptr_t)*arrays[i].at - (uintptr_t)mesh);
	saver_blob(s, copy, mesh->bytes);
	free(copy);
}

/* Turn offsets back into pointers. @return 0: one is outside the block */
static int relocate(struct gls_mesh *mesh, size_t n)
{
	struct mesh_array arrays[N_MESH_ARRAYS];
	struct scene_mesh *m = &mesh->mesh;

	if (mesh->bytes != n || (m->kind != SCENE_TRIANGLES && m->kind != SCENE_LINES && m->kind != SCENE_POINTS))
		return 0;
	m->crease = NULL; /* not used in replays */
	mesh_arrays(m, arrays);
	for (unsigned i = 0; i < N_MESH_ARRAYS; i++) {
		uintptr_t distance = (uintptr_t)*arrays[i].at;
		if (distance == 0)
			continue;
		if (distance < sizeof(*mesh) || distance > n || arrays[i].bytes > n - distance ||
		    (distance % 4 && i + 1 < N_MESH_ARRAYS))
			return 0;
		*arrays[i].at = (const char *)mesh + distance;
	}
	if (!m->position || !m->index)
		return 0;
	for (size_t i = 0; i < (size_t)m->primitive_count * m->kind; i++)
		if (m->index[i] >= m->vertex_count)
			return 0;
	return 1;
}

/* A mesh in the cache, with a reference for the caller. */
static struct gls_mesh *get_mesh(struct loader *l)
{
	struct gls_mesh *mesh, *known;
	uint64_t key;
	size_t n;
	uint8_t *data = loader_blob(l, &n);

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
	atomic_init(&mesh->refs, 2); /* one for the cache, one for the caller */
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

/* ---- calls of lists ---- */

static void put_value(struct bytes *b, const struct trace_value *v)
{
	bytes_put_u64(b, (uint64_t)(int64_t)v->type);
	bytes_put_u64(b, v->count);
	switch (v->type) {
	case TRACE_STRING:
	case TRACE_BLOB:
		bytes_put(b, v->blob, v->count);
		break;
	case TRACE_ARRAY: case TRACE_STRUCT: case TRACE_REPR:
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
		bytes_put_u64(s->out, op->mesh->given);
		bytes_put_u64(s->out, op->mesh->mesh != NULL);
		if (op->mesh->mesh)
			put_mesh(s, op->mesh->mesh);
	} else {
		bytes_put(s->out, op->floats, op->n * sizeof(float));
	}
}

static void *take(struct loader *l, struct arena *a, size_t n)
{
	void *out = loader_is_bad(l) ? NULL : arena_alloc(a, n ? n : 1);

	if (!out && !loader_is_bad(l))
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
	case TRACE_ARRAY: case TRACE_STRUCT: case TRACE_REPR:
		if (depth == MAX_VALUE_DEPTH || v->count > (uint64_t)(l->in.end - l->in.p) / 16) {
			l->in.failed = 1;
			break;
		}
		items = take(l, a, v->count * sizeof(*items));
		for (uint64_t i = 0; i < v->count && items && !loader_is_bad(l); i++)
			get_value(l, a, &items[i], depth + 1);
		v->items = items;
		if (items && !loader_is_bad(l))
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
	    (op->form != GLS_OP_MESH && !gls_commands[op->command].kind) || /* nothing runs it */
	    (op->form != GLS_OP_MESH && op->form != GLS_OP_CALL && op->n > 16)) /* the room in unpack_call */
		l->in.failed = 1;
	if (op->form == GLS_OP_CALL) {
		op->args = args = take(l, &list->arena, op->n * sizeof(*args));
		for (uint32_t i = 0; i < op->n && args && !loader_is_bad(l); i++)
			get_value(l, &list->arena, &args[i], 0);
		if (cursor_u64(&l->in)) {
			op->unpack = unpack = take(l, &list->arena, sizeof(*unpack));
			if (unpack)
				cursor_copy(&l->in, unpack, sizeof(*unpack));
			l->in.failed |= unpack && unpack->alignment < 1; /* used as a divisor */
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
	kept->given = (uint32_t)cursor_u64(&l->in);
	if (cursor_u64(&l->in))
		kept->mesh = get_mesh(l);
}

/* ---- lists ---- */

/* A list is a blob of its own: most lists are the same at every checkpoint, and none changes once it is complete. */
static void put_list(struct saver *s, void *value)
{
	struct gls_list *list = value;
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
		hash_bytes(own.data, own.n, list->name);
	saver_named_blob(s, list->name, own.data, own.n);
	if (!s->blobs->count && !s->err) {
		list->bytes = own.n;
		list->held = s->held - before;
	}
	free(own.data);
}

static void *get_list(struct loader *l)
{
	size_t n_bytes;
	uint8_t *data = loader_blob(l, &n_bytes);
	struct cursor outer = l->in;
	struct gls_list *list = loader_alloc(l, sizeof(*list));
	uint64_t n;

	if (!data || !list) {
		l->in.failed |= !data;
		free(data);
		free(list);
		return NULL;
	}
	l->in = (struct cursor){ data, data + n_bytes, 0 };
	n = loader_count(l, 24);
	list->ops = loader_alloc(l, n * sizeof(*list->ops));
	list->room = list->ops ? (uint32_t)n : 0;
	for (; list->n < list->room && !loader_is_bad(l); list->n++) {
		get_op(l, list, &list->ops[list->n]);
		if (loader_is_bad(l) && list->ops[list->n].form == GLS_OP_MESH && !list->ops[list->n].mesh)
			list->ops[list->n].form = GLS_OP_CALL; /* owns nothing to free */
	}
	outer.failed |= l->in.failed;
	l->in = outer;
	free(data);
	if (loader_is_bad(l)) {
		gls_list_free(list);
		return NULL;
	}
	return list;
}

static void drop_list(void *list)
{
	gls_list_free(list);
}

const struct snapshot_table snapshot_lists = { "list", 32, put_list, get_list, drop_list };
