/* The cache of meshes: collected vertices are hashed, and equal ones share a mesh. */
#include "replay/build/mesh.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

#define MESH_KEEP_FRAMES 120             /* number of frames that an unused mesh is kept */
#define MESH_KEEP_BYTES ((size_t)64 << 20) /* cache size below which nothing is dropped */

static void hash_attribute(XXH3_state_t *hash, const float *values, uint32_t n, unsigned width)
{
	float packed[256 * 3];

	if (width == 4) {
		XXH3_128bits_update(hash, values, (size_t)n * 16);
		return;
	}
	for (uint32_t at = 0; at < n; at += 256) {
		uint32_t here = n - at < 256 ? n - at : 256;
		for (uint32_t i = 0; i < here; i++)
			memcpy(packed + (size_t)i * width, values + 4 * (size_t)(at + i), width * sizeof(float));
		XXH3_128bits_update(hash, packed, here * width * sizeof(float));
	}
}

static unsigned attribute_width(unsigned attribute)
{
	return attribute == GLS_ATTR_NORMAL ? 3 : attribute == GLS_ATTR_FOG_COORD ? 1 : 4;
}

static XXH128_hash_t hash_of(const struct gls_geometry *g)
{
	const uint32_t head[] = { g->kind, g->varying, g->n_vertices, g->n_primitives, g->n_draws > 1, g->edges_told };
	XXH3_state_t hash;

	XXH3_128bits_reset(&hash);
	XXH3_128bits_update(&hash, head, sizeof(head));
	XXH3_128bits_update(&hash, g->position, (size_t)g->n_vertices * 16);
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (g->varying >> a & 1)
			hash_attribute(&hash, g->attribute[a], g->n_vertices, attribute_width(a));
	if (g->varying & SCENE_HAS_FACE)
		XXH3_128bits_update(&hash, g->face, g->n_vertices * sizeof(*g->face));
	XXH3_128bits_update(&hash, g->index, (size_t)g->n_primitives * g->kind * 4);
	if (g->n_draws > 1)
		XXH3_128bits_update(&hash, g->primitive_draw, (size_t)g->n_primitives * 4);
	if (g->edges_told)
		XXH3_128bits_update(&hash, g->edge_flags, g->n_primitives);
	return XXH3_128bits_digest(&hash);
}

static struct gls_mesh *build(const struct gls_geometry *g, XXH128_hash_t hash)
{
	size_t n = g->n_vertices, p = g->n_primitives, bytes = sizeof(struct gls_mesh) + n * 16 + p * g->kind * 4;
	const float **arrays[N_GLS_ATTRIBUTES];
	struct gls_mesh *m;
	struct scene_mesh *mesh;
	uint8_t *at;

	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		bytes += g->varying >> a & 1 ? n * attribute_width(a) * sizeof(float) : 0;
	bytes += g->varying & SCENE_HAS_FACE ? n * sizeof(*g->face) : 0;
	bytes += (g->n_draws > 1 ? p * 4 : 0) + (g->edges_told ? p : 0);
	bytes = (bytes + 63) & ~(size_t)63;
	m = aligned_alloc(64, bytes);
	if (!m)
		return NULL;
	memset(m, 0, sizeof(*m));
	memset((uint8_t *)m + bytes - 64, 0, 64); /* padding, so that equal meshes have equal bytes */
	mesh = &m->mesh;
	arrays[GLS_ATTR_NORMAL] = &mesh->normal;
	arrays[GLS_ATTR_COLOR] = &mesh->color;
	arrays[GLS_ATTR_SECONDARY] = &mesh->secondary;
	arrays[GLS_ATTR_FOG_COORD] = &mesh->fog_coord;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		arrays[GLS_ATTR_TEXCOORD + u] = &mesh->texcoord[u];
	for (unsigned i = 0; i < SCENE_MAX_GENERICS; i++)
		arrays[GLS_ATTR_GENERIC + i] = &mesh->generics[i];
	mesh->hash[0] = hash.low64;
	mesh->hash[1] = hash.high64;
	mesh->kind = g->kind;
	mesh->vertex_count = g->n_vertices;
	mesh->primitive_count = g->n_primitives;
	mesh->attributes = g->varying;
	m->bytes = bytes;
	m->n_draws = g->n_draws ? g->n_draws : 1;
	atomic_init(&m->refs, 1);

	at = (uint8_t *)(m + 1);
	mesh->position = memcpy(at, g->position, n * 16);
	at += n * 16;
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++) {
		unsigned width = attribute_width(a);
		if (!(g->varying >> a & 1))
			continue;
		*arrays[a] = (const float *)at;
		for (size_t i = 0; i < n; i++, at += width * sizeof(float))
			memcpy(at, g->attribute[a] + 4 * i, width * sizeof(float));
	}
	if (g->varying & SCENE_HAS_FACE) {
		mesh->face = memcpy(at, g->face, n * sizeof(*g->face));
		at += n * sizeof(*g->face);
	}
	mesh->index = memcpy(at, g->index, p * g->kind * 4);
	at += p * g->kind * 4;
	if (g->n_draws > 1) {
		mesh->primitive_draw = memcpy(at, g->primitive_draw, p * 4);
		at += p * 4;
	}
	if (g->edges_told)
		mesh->edge_flags = memcpy(at, g->edge_flags, p);
	return m;
}

struct gls_mesh *gls_geometry_mesh(struct gls_exec *x, struct gls_geometry *g)
{
	XXH128_hash_t hash;
	struct gls_mesh *m;
	uint64_t key;

	if (!g->n_primitives)
		return NULL;
	hash = hash_of(g);
	for (key = hash.low64; (m = table_find(&x->caches.meshes, key)); key++)
		if (m->mesh.hash[0] == hash.low64 && m->mesh.hash[1] == hash.high64)
			break;
	if (!m) {
		m = build(g, hash);
		if (!m) {
			gls_out_of_memory(x, (size_t)g->n_vertices * 16);
			return NULL;
		}
		if (table_set(&x->caches.meshes, key, m)) {
			free(m);
			gls_fail(x);
			return NULL;
		}
		x->caches.mesh_bytes += m->bytes;
	}
	m->used_frame = x->frame;
	atomic_fetch_add(&m->refs, 1);
	return m;
}

void gls_mesh_release(struct gls_mesh *mesh)
{
	if (mesh && atomic_fetch_sub(&mesh->refs, 1) == 1)
		free(mesh);
}

/* Drop meshes that only the cache holds and that were not drawn for some frames; all: every mesh. */
static void drop_unused(struct gls_exec *x, int all)
{
	for (size_t i = 0; i < x->caches.meshes.room;) {
		struct table_entry e = x->caches.meshes.entries[i];
		struct gls_mesh *m = e.value;
		if (!m || (!all && (atomic_load(&m->refs) > 1 || m->used_frame + MESH_KEEP_FRAMES > x->frame))) {
			i++;
			continue;
		}
		x->caches.mesh_bytes -= m->bytes;
		table_remove(&x->caches.meshes, e.key); /* may move another entry here: look at this place again */
		gls_mesh_release(m);
	}
}

/* Array draws refer to meshes by key, without references (array_draw.c). Drop those entries first. */
static void forget_draws(struct gls_exec *x)
{
	table_free(&x->caches.draws);
}

void gls_mesh_cache_trim(struct gls_exec *x)
{
	if (x->caches.mesh_bytes < MESH_KEEP_BYTES || x->frame % MESH_KEEP_FRAMES)
		return;
	forget_draws(x);
	drop_unused(x, 0);
}

void gls_mesh_cache_free(struct gls_exec *x)
{
	forget_draws(x);
	drop_unused(x, 1);
	table_free(&x->caches.meshes);
}
