#include "replay/machine/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/mat4.h"
#include "base/memory.h"
#include "replay/machine/errors.h"

void gls_geometry_clear(struct gls_geometry *g)
{
	g->n_vertices = g->n_primitives = g->n_draws = g->begin_vertex = 0;
	g->varying = g->touched = g->given = g->edges_told = g->quads = 0;
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

/* Room for vertices and primitives. @return 0 or ERR_SYSTEM (reported) */
static int make_room(struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives)
{
	if (n_vertices > 0x10000000u || n_primitives > 0x10000000u)
		return err_report(ERR_SYSTEM, NULL, "a draw of %u vertices is more than can be held", n_vertices);
	if (g->n_vertices + n_vertices > g->room_vertices) {
		uint32_t room = g->room_vertices ? g->room_vertices : 256;
		while (room < g->n_vertices + n_vertices)
			room *= 2;
		if (memory_resize(&g->position, room, 16) || memory_resize(&g->edge, room, 1))
			return ERR_SYSTEM;
		for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
			if (g->attribute[a] && memory_resize(&g->attribute[a], room, 16))
				return ERR_SYSTEM;
		if (g->face && memory_resize(&g->face, room, sizeof(*g->face)))
			return ERR_SYSTEM;
		g->room_vertices = room;
	}
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (g->varying >> a & 1 && !g->attribute[a] && memory_resize(&g->attribute[a], g->room_vertices, 16))
			return ERR_SYSTEM;
	if (g->varying & SCENE_HAS_FACE && !g->face && memory_resize(&g->face, g->room_vertices, sizeof(*g->face)))
		return ERR_SYSTEM;
	if (g->n_primitives + n_primitives > g->room_primitives) {
		uint32_t room = g->room_primitives ? g->room_primitives : 256;
		while (room < g->n_primitives + n_primitives)
			room *= 2;
		if (memory_resize(&g->index, room, 12) || memory_resize(&g->primitive_draw, room, 4) ||
		    memory_resize(&g->edge_flags, room, 1))
			return ERR_SYSTEM;
		g->room_primitives = room;
	}
	return 0;
}

int gls_geometry_reserve(struct gls_exec *x, struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives)
{
	const int rc = make_room(g, n_vertices, n_primitives);

	if (rc)
		gls_fail(x);
	return rc;
}

/* Make something vary, if there is room for it. bit: of g->varying */
static int vary(struct gls_exec *x, struct gls_geometry *g, uint32_t bit)
{
	g->varying |= bit;
	if (gls_geometry_reserve(x, g, 0, 0) == 0)
		return 0;
	g->varying &= ~bit;
	return ERR_SYSTEM;
}

int gls_geometry_vary(struct gls_exec *x, struct gls_geometry *g, unsigned attribute)
{
	if (vary(x, g, 1u << attribute))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < g->n_vertices; i++)
		memcpy(g->attribute[attribute] + 4 * (size_t)i, g->constant[attribute], 16);
	return 0;
}

int gls_geometry_vary_face(struct gls_exec *x, struct gls_geometry *g, const struct scene_face face[2])
{
	if (vary(x, g, SCENE_HAS_FACE))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < g->n_vertices; i++)
		memcpy(g->face[i], face, sizeof(*g->face));
	return 0;
}

enum scene_primitive gls_mode_kind(uint32_t mode)
{
	static const uint8_t kinds[] = {
		[GL_POINTS] = SCENE_POINTS, [GL_LINES] = SCENE_LINES, [GL_LINE_LOOP] = SCENE_LINES, [GL_LINE_STRIP] = SCENE_LINES,
		[GL_TRIANGLES] = SCENE_TRIANGLES, [GL_TRIANGLE_STRIP] = SCENE_TRIANGLES, [GL_TRIANGLE_FAN] = SCENE_TRIANGLES,
		[GL_QUADS] = SCENE_TRIANGLES, [GL_QUAD_STRIP] = SCENE_TRIANGLES, [GL_POLYGON] = SCENE_TRIANGLES,
	};

	return mode < sizeof(kinds) ? kinds[mode] : 0;
}

/* ---- splitting primitives ---- */

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

/* edges: 0 or SCENE_CONTINUES */
static void put_line(const struct cutter *c, uint32_t i, uint32_t j, unsigned edges)
{
	struct gls_geometry *g = c->g;
	uint32_t *index = g->index + 2 * (size_t)g->n_primitives;

	index[0] = vertex_of(c, i);
	index[1] = vertex_of(c, j);
	g->edge_flags[g->n_primitives] = (uint8_t)(3 | edges);
	g->edges_told |= edges;
	g->primitive_draw[g->n_primitives++] = g->n_draws;
}

/*
 * edges: bit n is set if the edge from vertex n to the next is a boundary edge; or SCENE_CONTINUES. In strips and fans
 * every edge is a boundary (sec. 2.6.2), but Mesa applies the vertices' edge flags there as well.
 */
static void put_triangle(const struct cutter *c, uint32_t i, uint32_t j, uint32_t k, unsigned edges)
{
	struct gls_geometry *g = c->g;
	uint32_t *index = g->index + 3 * (size_t)g->n_primitives;

	index[0] = vertex_of(c, i);
	index[1] = vertex_of(c, j);
	index[2] = vertex_of(c, k);
	edges &= g->edge[index[0]] | g->edge[index[1]] << 1 | g->edge[index[2]] << 2 | ~7u;
	g->edge_flags[g->n_primitives] = (uint8_t)edges;
	g->edges_told |= edges != 7;
	g->primitive_draw[g->n_primitives++] = g->n_draws;
}

int gls_geometry_cut(struct gls_exec *x, struct gls_geometry *g, uint32_t mode, uint32_t first, uint32_t count,
                     const uint32_t *elements, int first_provokes)
{
	const struct cutter c = { g, elements, first };
	uint32_t i;

	if (gls_geometry_reserve(x, g, 0, count ? count : 1))
		return ERR_SYSTEM;
	switch (mode) {
	case GL_POINTS:
		for (i = 0; i < count; i++)
			put_point(&c, i);
		break;
	case GL_LINES:
		for (i = 0; i + 1 < count; i += 2)
			put_line(&c, i, i + 1, 0);
		break;
	case GL_LINE_STRIP:
	case GL_LINE_LOOP:
		for (i = 0; i + 1 < count; i++)
			put_line(&c, i, i + 1, i ? SCENE_CONTINUES : 0);
		if (mode == GL_LINE_LOOP && count > 1)
			put_line(&c, count - 1, 0, SCENE_CONTINUES);
		break;
	case GL_TRIANGLES: /* the provoking vertex is the last one */
		for (i = 0; i + 2 < count; i += 3)
			put_triangle(&c, first_provokes ? i + 1 : i, first_provokes ? i + 2 : i + 1, first_provokes ? i : i + 2, 7);
		break;
	case GL_TRIANGLE_STRIP:
		for (i = 2; i < count && first_provokes; i++)
			put_triangle(&c, i + (i & 1) - 1, i - (i & 1), i - 2, 7);
		for (i = 2; i < count && !first_provokes; i++)
			put_triangle(&c, i + (i & 1) - 2, i - (i & 1) - 1, i, 7);
		break;
	case GL_TRIANGLE_FAN:
		for (i = 2; i < count; i++)
			put_triangle(&c, first_provokes ? i : 0, first_provokes ? 0 : i - 1, first_provokes ? i - 1 : i, 7);
		break;
	case GL_QUADS: /* llvmpipe always takes a quad's last vertex as the provoking one */
		for (i = 0; i + 3 < count; i += 4) {
			put_triangle(&c, i, i + 1, i + 3, 1 | 4);
			put_triangle(&c, i + 1, i + 2, i + 3, 1 | 2 | SCENE_CONTINUES);
		}
		break;
	case GL_QUAD_STRIP:
		for (i = 3; i < count; i += 2) {
			put_triangle(&c, i - 3, i - 2, i, 1 | 2 | SCENE_CONTINUES);
			put_triangle(&c, i - 1, i - 3, i, 1 | 4 | SCENE_EARLIER);
		}
		break;
	case GL_POLYGON: /* its first vertex is the provoking one, so each triangle ends with it */
		for (i = 2; i < count; i++) {
			unsigned edges = 1u | (i == count - 1 ? 2u : 0) | (i == 2 ? 4u : 0);
			put_triangle(&c, i - 1, i, 0, edges | (i > 2 ? SCENE_CONTINUES : 0));
		}
		break;
	}
	return 0;
}

/* End of the draw that begins with this primitive. is_loop: receives 1 if its last line returns to its first vertex */
static uint32_t end_of_draw(const struct gls_geometry *g, uint32_t first, int *is_loop)
{
	uint32_t end = first + 1;

	while (end < g->n_primitives && g->primitive_draw[end] == g->primitive_draw[first])
		end++;
	*is_loop = end > first + 1 && g->index[2 * (size_t)end - 1] == g->index[2 * (size_t)first];
	return end;
}

void gls_geometry_part_strips(struct gls_geometry *g)
{
	int after_lines = 0, is_loop, next_is_loop = 1;

	g->edges_told = 0;
	for (uint32_t first = 0, end; first < g->n_primitives; first = end) {
		end = end_of_draw(g, first, &is_loop);
		if (end < g->n_primitives)
			end_of_draw(g, end, &next_is_loop);
		for (uint32_t i = first; i < end; i++) {
			if (!is_loop && (after_lines || (end < g->n_primitives && !next_is_loop)))
				g->edge_flags[i] &= (uint8_t)~SCENE_CONTINUES;
			g->edges_told |= g->edge_flags[i] & SCENE_CONTINUES;
		}
		after_lines = !is_loop;
	}
}

void gls_geometry_turn_quads(struct gls_geometry *g)
{
	for (uint32_t i = 0; i + 1 < g->n_primitives; i += 2) {
		uint32_t *index = g->index + 3 * (size_t)i, a = index[0], b = index[1], c = index[4], d = index[5];
		uint8_t first = g->edge_flags[i], second = g->edge_flags[i + 1];

		memcpy(index, (uint32_t[6]){ a, b, c, a, c, d }, 6 * sizeof(*index));
		/* before: a-b, (b-d), d-a and b-c, c-d, (d-b); now: a-b, b-c, (c-a) and (a-c), c-d, d-a */
		g->edge_flags[i] = (uint8_t)((first & 1) | (second & 1) << 1);
		g->edge_flags[i + 1] = (uint8_t)((second & (2 | SCENE_CONTINUES)) | (first & 4));
	}
}

int gls_quads_turn(const struct gls_state *st, int is_flat, const float *position, const uint32_t *index,
                   uint32_t n_primitives)
{
	static const unsigned corners[4] = { 0, 1, 2, 4 }; /* in the six indices of a quad's two triangles */
	const struct gls_attribs *a = &st->a;
	const float *modelview = st->modelview.matrices[st->modelview.depth];
	float mvp[16];

	if (is_flat || a->polygon.mode[0] != GL_FILL || a->polygon.mode[1] != GL_FILL || a->polygon.stipple)
		return 0;
	if (gls_draws_by_stages(a) && (a->polygon.offset_point || a->polygon.offset_line || a->polygon.offset_fill ||
	                               (a->lighting.enabled && a->lighting.two_side)))
		return 0;
	gls_sums(st)->mul(mvp, st->projection.matrices[st->projection.depth], modelview);
	for (uint32_t i = 0; i < 2 * n_primitives; i++) {
		const float *corner = position + 4 * (size_t)index[6 * (size_t)(i / 4) + corners[i % 4]];
		float c[4], eye[4];

		mat4_transform(c, mvp, corner);
		if (!(fabsf(c[0]) <= c[3] && fabsf(c[1]) <= c[3] && fabsf(c[2]) <= c[3]))
			return 0;
		if (!a->transform.clip_plane_mask)
			continue;
		mat4_transform(eye, modelview, corner);
		if (gls_is_beyond_clip_planes(a, eye))
			return 0;
	}
	return 1;
}
