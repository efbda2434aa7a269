/* Vertices into meshes: cutting primitives (GL 2.1 sec. 2.6.1), finding meshes by content, keeping them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "replay/machine/exec.h"
#include "base/mat4.h"

#define MESH_KEEP_FRAMES 120             /* frames that an unused mesh is kept */
#define MESH_KEEP_BYTES ((size_t)64 << 20) /* cache size below which nothing is dropped */

void gls_geometry_clear(struct gls_geometry *g)
{
	g->n_vertices = g->n_primitives = g->n_draws = g->begin_vertex = 0;
	g->given = g->touched = g->edges_hidden = g->quads = 0;
}

void gls_geometry_free(struct gls_geometry *g)
{
	free(g->position);
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		free(g->attribute[a]);
	free(g->face);
	free(g->edge);
	free(g->index);
	free(g->primitive_draw);
	free(g->edge_flags);
	memset(g, 0, sizeof(*g));
}

static int resize(void *pointer, size_t n, size_t size)
{
	void **p = pointer, *grown = realloc(*p, n * size);

	if (!grown)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %zu vertices or primitives", n);
	*p = grown;
	return 0;
}

int gls_geometry_reserve(struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives)
{
	if (n_vertices > 0x10000000u || n_primitives > 0x10000000u)
		return err_report(ERR_SYSTEM, NULL, "a draw of %u vertices is more than can be held", n_vertices);
	if (g->n_vertices + n_vertices > g->room_vertices) {
		uint32_t room = g->room_vertices ? g->room_vertices : 256;
		while (room < g->n_vertices + n_vertices)
			room *= 2;
		if (resize(&g->position, room, 16) || resize(&g->edge, room, 1))
			return ERR_SYSTEM;
		for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
			if (g->attribute[a] && resize(&g->attribute[a], room, 16))
				return ERR_SYSTEM;
		if (g->face && resize(&g->face, room, sizeof(*g->face)))
			return ERR_SYSTEM;
		g->room_vertices = room;
	}
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (g->given >> a & 1 && !g->attribute[a] && resize(&g->attribute[a], g->room_vertices, 16))
			return ERR_SYSTEM;
	if (g->given & SCENE_HAS_FACE && !g->face && resize(&g->face, g->room_vertices, sizeof(*g->face)))
		return ERR_SYSTEM;
	if (g->n_primitives + n_primitives > g->room_primitives) {
		uint32_t room = g->room_primitives ? g->room_primitives : 256;
		while (room < g->n_primitives + n_primitives)
			room *= 2;
		if (resize(&g->index, room, 12) || resize(&g->primitive_draw, room, 4) || resize(&g->edge_flags, room, 1))
			return ERR_SYSTEM;
		g->room_primitives = room;
	}
	return 0;
}

int gls_geometry_vary(struct gls_geometry *g, unsigned attribute)
{
	g->given |= 1u << attribute;
	if (gls_geometry_reserve(g, 0, 0))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < g->n_vertices; i++)
		memcpy(g->attribute[attribute] + 4 * (size_t)i, g->constant[attribute], 16);
	return 0;
}

int gls_geometry_vary_face(struct gls_geometry *g, const struct scene_face face[2])
{
	g->given |= SCENE_HAS_FACE;
	if (gls_geometry_reserve(g, 0, 0))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < g->n_vertices; i++)
		memcpy(g->face[i], face, sizeof(*g->face));
	return 0;
}

enum scene_primitive gls_mode_kind(uint32_t mode)
{
	switch (mode) {
	case GL_POINTS:
		return SCENE_POINTS;
	case GL_LINES:
	case GL_LINE_LOOP:
	case GL_LINE_STRIP:
		return SCENE_LINES;
	case GL_TRIANGLES:
	case GL_TRIANGLE_STRIP:
	case GL_TRIANGLE_FAN:
	case GL_QUADS:
	case GL_QUAD_STRIP:
	case GL_POLYGON:
		return SCENE_TRIANGLES;
	default:
		return 0;
	}
}

/* ---- cutting ---- */

struct cutter {
	struct gls_geometry *g;
	const uint32_t *elements;
	uint32_t first;
};

static uint32_t vertex_of(const struct cutter *c, uint32_t i)
{
	return c->elements ? c->elements[i] : c->first + i;
}

static void put_point(const struct cutter *c, uint32_t i)
{
	struct gls_geometry *g = c->g;

	g->index[g->n_primitives] = vertex_of(c, i);
	g->edge_flags[g->n_primitives] = 1;
	g->primitive_draw[g->n_primitives++] = g->n_draws;
}

static void put_line(const struct cutter *c, uint32_t i, uint32_t j)
{
	struct gls_geometry *g = c->g;
	uint32_t *index = g->index + 2 * (size_t)g->n_primitives;

	index[0] = vertex_of(c, i);
	index[1] = vertex_of(c, j);
	g->edge_flags[g->n_primitives] = 3;
	g->primitive_draw[g->n_primitives++] = g->n_draws;
}

/* `edges`: bit n where the edge from the triangle's vertex n to the next is one of the primitive's own. */
static void put_triangle(const struct cutter *c, uint32_t i, uint32_t j, uint32_t k, unsigned edges)
{
	struct gls_geometry *g = c->g;
	uint32_t *index = g->index + 3 * (size_t)g->n_primitives;

	index[0] = vertex_of(c, i);
	index[1] = vertex_of(c, j);
	index[2] = vertex_of(c, k);
	g->edge_flags[g->n_primitives] = (uint8_t)edges;
	g->edges_hidden |= edges != 7;
	g->primitive_draw[g->n_primitives++] = g->n_draws;
}

/* Edge flags count for separate triangles, quads and polygons only (sec. 2.6.2). */
static unsigned flags(const struct cutter *c, uint32_t i, uint32_t j, uint32_t k, unsigned edges)
{
	const uint8_t *edge = c->g->edge;

	return edges & (edge[vertex_of(c, i)] | edge[vertex_of(c, j)] << 1 | edge[vertex_of(c, k)] << 2);
}

/* The triangle with its provoking vertex last: i, or k as it is. */
static void put_provoked(const struct cutter *c, uint32_t i, uint32_t j, uint32_t k, unsigned edges, int first_provokes)
{
	if (first_provokes)
		put_triangle(c, j, k, i, (edges >> 1 | edges << 2) & 7);
	else
		put_triangle(c, i, j, k, edges);
}

int gls_geometry_cut(struct gls_geometry *g, uint32_t mode, uint32_t first, uint32_t count, const uint32_t *elements, int first_provokes)
{
	const struct cutter c = { g, elements, first };
	uint32_t i;

	if (gls_geometry_reserve(g, 0, count ? count : 1))
		return ERR_SYSTEM;
	switch (mode) {
	case GL_POINTS:
		for (i = 0; i < count; i++)
			put_point(&c, i);
		break;
	case GL_LINES:
		for (i = 0; i + 1 < count; i += 2)
			put_line(&c, i, i + 1);
		break;
	case GL_LINE_STRIP:
	case GL_LINE_LOOP:
		for (i = 0; i + 1 < count; i++)
			put_line(&c, i, i + 1);
		if (mode == GL_LINE_LOOP && count > 1)
			put_line(&c, count - 1, 0);
		break;
	case GL_TRIANGLES:
		for (i = 0; i + 2 < count; i += 3)
			put_provoked(&c, i, i + 1, i + 2, flags(&c, i, i + 1, i + 2, 7), first_provokes);
		break;
	case GL_TRIANGLE_STRIP:
		for (i = 2; i < count && first_provokes; i++)
			put_provoked(&c, i - 2, i + (i & 1) - 1, i - (i & 1), 7, 1);
		for (i = 2; i < count && !first_provokes; i++)
			put_triangle(&c, i + (i & 1) - 2, i - (i & 1) - 1, i, 7);
		break;
	case GL_TRIANGLE_FAN:
		for (i = 2; i < count; i++)
			put_triangle(&c, first_provokes ? i : 0, first_provokes ? 0 : i - 1, first_provokes ? i - 1 : i, 7);
		break;
	case GL_QUADS: /* llvmpipe has quads follow the last vertex in any case */
		for (i = 0; i + 3 < count; i += 4) {
			put_triangle(&c, i, i + 1, i + 3, flags(&c, i, i + 1, i + 3, 1 | 4));
			put_triangle(&c, i + 1, i + 2, i + 3, flags(&c, i + 1, i + 2, i + 3, 1 | 2));
		}
		break;
	case GL_QUAD_STRIP:
		for (i = 3; i < count; i += 2) {
			put_triangle(&c, i - 3, i - 2, i, 1 | 2);
			put_triangle(&c, i - 1, i - 3, i, 1 | 4);
		}
		break;
	case GL_POLYGON: /* its first vertex is the provoking one, so each triangle ends with it */
		for (i = 2; i < count; i++) {
			unsigned edges = 1u | (i == count - 1 ? 2u : 0) | (i == 2 ? 4u : 0);
			put_triangle(&c, i - 1, i, 0, flags(&c, i - 1, i, 0, edges));
		}
		break;
	}
	return 0;
}

void gls_geometry_turn_quads(struct gls_geometry *g)
{
	for (uint32_t i = 0; i + 1 < g->n_primitives; i += 2) {
		uint32_t *index = g->index + 3 * (size_t)i, a = index[0], b = index[1], c = index[4], d = index[5];
		uint8_t first = g->edge_flags[i], second = g->edge_flags[i + 1];

		memcpy(index, (uint32_t[6]){ a, b, c, a, c, d }, 6 * sizeof(*index));
		/* they were a-b, (b-d), d-a and b-c, c-d, (d-b); they are a-b, b-c, (c-a) and (a-c), c-d, d-a */
		g->edge_flags[i] = (uint8_t)((first & 1) | (second & 1) << 1);
		g->edge_flags[i + 1] = (uint8_t)((second & 2) | (first & 4));
	}
}

int gls_quads_turn(const struct gls_state *st, const float *position, uint32_t n)
{
	const struct gls_attribs *a = &st->a;
	float mvp[16];

	if (a->lighting.shade_model != GL_SMOOTH || a->polygon.mode[0] != GL_FILL || a->polygon.mode[1] != GL_FILL ||
	    a->transform.clip_plane_mask)
		return 0;
	mat4_mul(mvp, st->projection.matrices[st->projection.depth], st->modelview.matrices[st->modelview.depth]);
	for (uint32_t i = 0; i < n; i++) {
		float c[4];

		mat4_transform(c, mvp, position + 4 * (size_t)i);
		if (!(fabsf(c[0]) <= c[3] && fabsf(c[1]) <= c[3] && fabsf(c[2]) <= c[3]))
			return 0;
	}
	return 1;
}

/* ---- meshes ---- */

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
	const uint32_t head[] = { g->kind, g->given, g->n_vertices, g->n_primitives, g->n_draws > 1, g->edges_hidden };
	XXH3_state_t hash;

	XXH3_128bits_reset(&hash);
	XXH3_128bits_update(&hash, head, sizeof(head));
	XXH3_128bits_update(&hash, g->position, (size_t)g->n_vertices * 16);
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (g->given >> a & 1)
			hash_attribute(&hash, g->attribute[a], g->n_vertices, attribute_width(a));
	if (g->given & SCENE_HAS_FACE)
		XXH3_128bits_update(&hash, g->face, g->n_vertices * sizeof(*g->face));
	XXH3_128bits_update(&hash, g->index, (size_t)g->n_primitives * g->kind * 4);
	if (g->n_draws > 1)
		XXH3_128bits_update(&hash, g->primitive_draw, (size_t)g->n_primitives * 4);
	if (g->edges_hidden)
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
		bytes += g->given >> a & 1 ? n * attribute_width(a) * sizeof(float) : 0;
	bytes += g->given & SCENE_HAS_FACE ? n * sizeof(*g->face) : 0;
	bytes += (g->n_draws > 1 ? p * 4 : 0) + (g->edges_hidden ? p : 0);
	bytes = (bytes + 63) & ~(size_t)63;
	m = aligned_alloc(64, bytes);
	if (!m)
		return NULL;
	memset(m, 0, sizeof(*m));
	memset((uint8_t *)m + bytes - 64, 0, 64); /* what rounding up left over: equal meshes are equal bytes */
	mesh = &m->mesh;
	arrays[GLS_ATTR_NORMAL] = &mesh->normal;
	arrays[GLS_ATTR_COLOR] = &mesh->color;
	arrays[GLS_ATTR_SECONDARY] = &mesh->secondary;
	arrays[GLS_ATTR_FOG_COORD] = &mesh->fog_coord;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		arrays[GLS_ATTR_TEXCOORD + u] = &mesh->texcoord[u];
	mesh->hash[0] = hash.low64;
	mesh->hash[1] = hash.high64;
	mesh->kind = g->kind;
	mesh->vertex_count = g->n_vertices;
	mesh->primitive_count = g->n_primitives;
	mesh->attributes = g->given;
	m->bytes = bytes;
	m->n_draws = g->n_draws ? g->n_draws : 1;
	atomic_init(&m->refs, 1);

	at = (uint8_t *)(m + 1);
	mesh->position = memcpy(at, g->position, n * 16);
	at += n * 16;
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++) {
		unsigned width = attribute_width(a);
		if (!(g->given >> a & 1))
			continue;
		*arrays[a] = (const float *)at;
		for (size_t i = 0; i < n; i++, at += width * sizeof(float))
			memcpy(at, g->attribute[a] + 4 * i, width * sizeof(float));
	}
	if (g->given & SCENE_HAS_FACE) {
		mesh->face = memcpy(at, g->face, n * sizeof(*g->face));
		at += n * sizeof(*g->face);
	}
	mesh->index = memcpy(at, g->index, p * g->kind * 4);
	at += p * g->kind * 4;
	if (g->n_draws > 1) {
		mesh->primitive_draw = memcpy(at, g->primitive_draw, p * 4);
		at += p * 4;
	}
	if (g->edges_hidden)
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
	for (key = hash.low64; (m = table_find(&x->meshes, key)); key++)
		if (m->mesh.hash[0] == hash.low64 && m->mesh.hash[1] == hash.high64)
			break;
	if (!m) {
		m = build(g, hash);
		if (!m || table_set(&x->meshes, key, m)) {
			free(m);
			gls_out_of_memory(x, 0);
			return NULL;
		}
		x->mesh_bytes += m->bytes;
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

/* Drop what the cache alone holds and nobody drew for some frames (all: everything of its own). */
static void drop_unused(struct gls_exec *x, int all)
{
	for (size_t i = 0; i < x->meshes.room;) {
		struct table_entry e = x->meshes.entries[i];
		struct gls_mesh *m = e.value;
		if (!m || (!all && (atomic_load(&m->refs) > 1 || m->used_frame + MESH_KEEP_FRAMES > x->frame))) {
			i++;
			continue;
		}
		x->mesh_bytes -= m->bytes;
		table_remove(&x->meshes, e.key); /* may move another one into this place: look again */
		gls_mesh_release(m);
	}
}

/* Array draws remember meshes by key (array.c) without references of their own: forget those first. */
static void forget_draws(struct gls_exec *x)
{
	table_free(&x->draws);
}

void gls_mesh_cache_trim(struct gls_exec *x)
{
	if (x->mesh_bytes < MESH_KEEP_BYTES || x->frame % MESH_KEEP_FRAMES)
		return;
	forget_draws(x);
	drop_unused(x, 0);
}

void gls_mesh_cache_free(struct gls_exec *x)
{
	forget_draws(x);
	drop_unused(x, 1);
	table_free(&x->meshes);
}
