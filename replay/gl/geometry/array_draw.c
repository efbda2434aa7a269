/* Drawing from vertex arrays (GL 2.1 sec. 2.8). */
#include "replay/gl/geometry/array_draw.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/build/program.h"
#include "replay/gl/geometry/array_read.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/gl/surface/draw.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* The most vertices of a draw beyond the end of its buffer object: more would add primitives without extent. A multiple
 * of the vertices of each kind of primitive. */
#define MOST_BEYOND 12

/* Append the vertex of an element. @return 0 or ERR_SYSTEM (reported) */
static int add_vertex(struct gls_exec *x, const struct gls_state *st, struct gls_geometry *g,
                      const struct gls_sources *s, uint64_t element)
{
	if (g->n_vertices == g->room_vertices && gls_geometry_reserve(x, g, 1, 0))
		return ERR_SYSTEM;
	gls_source_read(&s->vertex, element, g->position + 4 * (size_t)g->n_vertices);
	for (uint32_t present = s->present; present; present &= present - 1) {
		unsigned a = (unsigned)__builtin_ctz(present);
		gls_source_read(&s->attributes[a], element, g->attribute[a] + 4 * (size_t)g->n_vertices);
	}
	g->edge[g->n_vertices] = st->a.current.edge_flag != 0;
	if (s->has_edges) {
		float flag[4];
		gls_source_read(&s->edge, element, flag);
		g->edge[g->n_vertices] = flag[0] != 0;
	}
	g->n_vertices++;
	return 0;
}

/*
 * Read the vertices of a draw into the scratch geometry. elements NULL: `count` of them from `first` on. Each element
 * becomes one vertex.
 * @return 0, ERR_INPUT (counted: indices beyond the end of client arrays) or ERR_SYSTEM (reported)
 */
static int collect(struct gls_exec *x, const struct gls_state *st, const struct gls_sources *s, uint32_t mode,
                   uint32_t first, uint32_t count, const uint32_t *elements)
{
	struct gls_geometry *g = &x->scratch.geometry;
	const uint32_t end = (uint32_t)gls_sources_end(s); /* elements from there on are the same vertex */
	uint32_t lo = UINT32_MAX, hi = 0, *number, *cut;

	gls_geometry_clear(g);
	g->kind = gls_mode_kind(mode);
	g->varying = s->present;
	if (gls_geometry_reserve(x, g, elements ? 1 : count, 0))
		return ERR_SYSTEM;
	if (!elements) {
		for (uint32_t i = 0; i < count; i++)
			if (add_vertex(x, st, g, s, (uint64_t)first + i))
				return ERR_SYSTEM;
		if (gls_geometry_cut(x, g, mode, 0, count, NULL, (int)st->a.lighting.first_provokes))
			return ERR_SYSTEM;
		g->n_draws = 1;
		return 0;
	}
	for (uint32_t i = 0; i < count; i++) {
		lo = elements[i] < lo ? elements[i] : lo;
		hi = elements[i] > hi ? elements[i] : hi;
	}
	if (count && hi >= gls_sources_count(s) && !s->vertex.array->buffer) {
		gls_unsupported(x, "indices beyond the end of an array");
		return ERR_INPUT;
	}
	lo = lo < end ? lo : end;
	hi = hi < end ? hi : end;
	/* Number vertices in order of first use, so that the mesh does not depend on its position in the arrays. */
	cut = gls_scratch(x, ((size_t)count + (hi - lo) + 1) * sizeof(*cut));
	if (!cut)
		return ERR_SYSTEM;
	number = cut + count;
	memset(number, 0xff, ((size_t)(hi - lo) + 1) * sizeof(*number));
	for (uint32_t i = 0; i < count; i++) {
		const uint32_t element = elements[i] < end ? elements[i] : end;
		uint32_t *slot = &number[element - lo];
		if (*slot == UINT32_MAX) {
			*slot = g->n_vertices;
			if (add_vertex(x, st, g, s, element))
				return ERR_SYSTEM;
		}
		cut[i] = *slot;
	}
	if (gls_geometry_cut(x, g, mode, 0, count, cut, (int)st->a.lighting.first_provokes))
		return ERR_SYSTEM;
	g->n_draws = 1;
	return 0;
}

/*
 * Draw a mesh, or add it to the list being compiled, or both.
 * @param kept        the mesh that a list stores instead
 * @param point_size  overrides the state's unless negative
 */
static void draw_or_store(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, struct gls_mesh *kept,
                float point_size)
{
	struct gls_op_mesh op = { .mesh = kept, .n_draws = 1, .given = kept->mesh.attributes,
		                  .first_provokes = st->a.lighting.first_provokes };

	if (st->list) {
		atomic_fetch_add(&kept->refs, 1);
		if (gls_list_append_mesh(x, st->list, &op) || st->list_mode == GL_COMPILE)
			return;
	}
	if (point_size >= 0 && gls_is_drawn(x, st)) {
		struct gls_attribs a = st->a;

		a.point.size = point_size;
		st->dirty |= GLS_DIRTY_MATERIAL;
		gls_draw_event(x, st,
		               &(struct gls_event){ .attribs = &a,
		                                    .mesh = mesh,
		                                    .values = (const float(*)[4])a.current.attribute,
		                                    .given = mesh->mesh.attributes,
		                                    .command = x->command,
		                                    .call_number = x->call->number });
		st->dirty |= GLS_DIRTY_MATERIAL;
		return;
	}
	gls_waiting_take(st, (int)st->waiting.stored);
	gls_draw_mesh(x, st, mesh,
	              &(struct gls_mesh_draw){ (const float(*)[4])st->a.current.attribute, mesh->mesh.attributes, x->command,
	                                     x->call->number });
}

/*
 * The mesh of a draw, owned by the cache. turned: quads are split along the other diagonal. @return NULL: nothing to
 * draw, or out of memory (reported)
 */
static struct gls_mesh *find_mesh(struct gls_exec *x, struct gls_state *st, struct gls_sources *s, uint32_t mode,
                                  uint32_t first, uint32_t count, const uint32_t *elements, int turned, uint64_t key)
{
	struct gls_mesh *mesh = table_find(&x->caches.draws, key);

	if (mesh || collect(x, st, s, mode, first, count, elements))
		return mesh;
	if (turned)
		gls_geometry_turn_quads(&x->scratch.geometry);
	mesh = gls_geometry_mesh(x, &x->scratch.geometry);
	if (mesh && table_set(&x->caches.draws, key, mesh))
		gls_fail(x);
	gls_mesh_release(mesh); /* the cache still has its own reference */
	return mesh;
}

/* Draw points with an array of sizes: consecutive points of the same size form one draw. */
static void draw_sized(struct gls_exec *x, struct gls_state *st, struct gls_sources *s, uint32_t first, uint32_t count,
                       const uint32_t *elements, uint64_t identity)
{
	float size[4], next[4];

	for (uint32_t begin = 0, end; begin < count; begin = end) {
		const uint32_t *run = elements ? elements + begin : NULL;
		struct gls_mesh *mesh;

		gls_source_read(&s->size, elements ? elements[begin] : first + begin, size);
		for (end = begin + 1; end < count; end++) {
			gls_source_read(&s->size, elements ? elements[end] : first + end, next);
			if (next[0] != size[0])
				break;
		}
		mesh = find_mesh(x, st, s, GL_POINTS, first + begin, end - begin, run, 0,
		                 gls_sources_key(st, s, GL_POINTS, elements ? identity + begin : first + begin,
		                                 (uint64_t)(end - begin) << 1 | (elements != NULL)));
		if (mesh)
			draw_or_store(x, st, mesh, mesh, size[0] > 0 ? size[0] : 0);
	}
}

/*
 * 1 if llvmpipe receives the quads without indices. While a list is compiled, Mesa executes them (COMPILE_AND_EXECUTE)
 * as vertices between Begin and End.
 */
static int quads_come_in_order(const struct gls_state *st, const uint32_t *elements)
{
	return st->list ? st->list_mode == GL_COMPILE_AND_EXECUTE : !elements;
}

/*
 * Draw, or add to the list being compiled.
 * @param elements  [count], NULL: first ..; `identity` distinguishes different ones (a hash, or version and offset)
 */
static void draw(struct gls_exec *x, struct gls_state *st, uint32_t mode, uint32_t first, uint32_t count,
                 const uint32_t *elements, uint64_t identity)
{
	struct gls_sources s;
	struct gls_mesh *mesh, *kept;
	uint64_t key;

	if (!x->want && !st->list)
		return;
	if (!count || !gls_sources_open(x, st, &s))
		return;
	if (!elements && (uint64_t)first + count > gls_sources_count(&s)) {
		const uint64_t end = gls_sources_end(&s), there = end > first ? end - first : 0;

		if (!s.vertex.array->buffer) {
			gls_unsupported(x, "draws beyond the end of an array");
			return;
		}
		count = count < there + MOST_BEYOND ? count : (uint32_t)(there + MOST_BEYOND);
	}
	if (mode == GL_POINTS && s.has_sizes) {
		draw_sized(x, st, &s, first, count, elements, identity);
		return;
	}
	key = gls_sources_key(st, &s, mode, elements ? identity : first, (uint64_t)count << 1 | (elements != NULL));
	mesh = kept = find_mesh(x, st, &s, mode, first, count, elements, 0, key);
	if (mesh && mode == GL_QUADS && quads_come_in_order(st, elements) &&
	    gls_quads_turn(st, gls_shades_flat(st), mesh->mesh.position, mesh->mesh.index, mesh->mesh.primitive_count))
		mesh = find_mesh(x, st, &s, mode, first, count, elements, 1, ~key);
	if (mesh)
		draw_or_store(x, st, mesh, kept, -1);
}

/* @return 1; 0: the draw is refused (GL error), or too large (counted) */
static int check_mode(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t count)
{
	if (!gls_mode_kind(mode))
		gls_error(x, st, GL_INVALID_ENUM);
	else if (count < 0)
		gls_error(x, st, GL_INVALID_VALUE);
	else if (count > 0x10000000)
		gls_unsupported(x, "draws of more than 2^28 vertices");
	else
		return 1;
	return 0;
}

void gls_draw_arrays(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t first, int64_t count)
{
	if (first < 0 || first > UINT32_MAX)
		gls_error(x, st, GL_INVALID_VALUE);
	else if (check_mode(x, st, mode, count))
		draw(x, st, mode, (uint32_t)first, (uint32_t)count, NULL, 0);
}

GLS_HANDLER(glDrawArrays, ARRAY) { gls_draw_arrays(x, st, arg_u(c, 0), arg_i(c, 1), arg_i(c, 2)); }

/* The mode of draw i: one for all, or element i of an array with this stride in bytes (IBM_multimode_draw_arrays). */
static uint32_t mode_of(const struct call *c, uint64_t i, int64_t stride)
{
	uint64_t n, place = i * ((uint64_t)stride / 4);
	const struct trace_value *modes = arg_items(c, 0, &n);

	return !modes ? arg_u(c, 0) : stride >= 0 && place < n ? (uint32_t)gls_value_int(&modes[place]) : GL_POLYGON + 1;
}

static void multi_draw_arrays(struct gls_exec *x, struct gls_state *st, const struct call *c, int64_t stride)
{
	uint64_t n_first, n_count;
	const struct trace_value *first = arg_items(c, 1, &n_first), *count = arg_items(c, 2, &n_count);

	for (uint64_t i = 0; i < n_first && i < n_count; i++)
		gls_draw_arrays(x, st, mode_of(c, i, stride), gls_value_int(&first[i]), gls_value_int(&count[i]));
}

GLS_HANDLER(glMultiDrawArrays, ARRAY) { multi_draw_arrays(x, st, c, 0); }
GLS_HANDLER(glMultiModeDrawArraysIBM, ARRAY) { multi_draw_arrays(x, st, c, arg_i(c, 4)); }

/* 1 if an index of this size ends a primitive and begins the next (NV_primitive_restart, GL 3.1 sec. 2.8.3). */
static int is_restart(const struct gls_client_attribs *client, uint32_t index, size_t bytes)
{
	return (client->restart && index == client->restart_index) ||
	       (client->restart_fixed && index == 0xffffffffu >> (32 - 8 * bytes));
}

void gls_draw_elements(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t count, uint32_t type,
                       const struct trace_value *indices, int32_t base)
{
	struct gls_buffer *b = gls_buffer_find(st, st->client.element_buffer);
	size_t size = gls_type_bytes(type), n = 0;
	const uint8_t *bytes = NULL;
	uint64_t identity, offset = 0;
	uint32_t *elements;
	int64_t begin = 0;

	if (gls_refuses(x, st, type != GL_UNSIGNED_BYTE && type != GL_UNSIGNED_SHORT && type != GL_UNSIGNED_INT,
	                GL_INVALID_ENUM))
		return;
	if (!check_mode(x, st, mode, count) || count == 0 || (!x->want && !st->list))
		return;
	if (indices->type == TRACE_BLOB) {
		bytes = indices->blob;
		n = indices->count;
		b = NULL;
	} else if (b) {
		offset = (uint64_t)gls_value_int(indices);
		bytes = offset < b->bytes ? b->data + offset : NULL;
		n = bytes ? b->bytes - offset : 0;
		gls_buffer_draws(x, st, b);
	}
	if (!bytes || n / size < (uint64_t)count) {
		gls_unsupported(x, "indices that are not in the recording");
		return;
	}
	elements = x->scratch.elements;
	if ((size_t)count > x->scratch.elements_room) {
		elements = realloc(x->scratch.elements, (size_t)count * sizeof(*elements));
		if (!elements) {
			gls_out_of_memory(x, (size_t)count * sizeof(*elements));
			return;
		}
		x->scratch.elements = elements;
		x->scratch.elements_room = (size_t)count;
	}
	/* Indices in a buffer are identified by its version and their offset; no hash is needed. */
	if (b)
		identity = XXH3_64bits((uint64_t[]){ b->version, offset, type, (uint64_t)base }, 32);
	else
		identity = XXH3_64bits_withSeed(bytes, (size_t)count * size, (uint64_t)type << 32 | (uint32_t)base);
	for (int64_t i = 0; i < count; i++) {
		uint16_t u16;
		uint32_t u32 = bytes[(size_t)i * size];
		if (size == 2) {
			memcpy(&u16, bytes + 2 * i, 2);
			u32 = u16;
		} else if (size == 4) {
			memcpy(&u32, bytes + 4 * i, 4);
		}
		if (is_restart(&st->client, u32, size)) {
			draw(x, st, mode, 0, (uint32_t)(i - begin), elements + begin, identity + (uint64_t)begin);
			begin = i + 1;
		}
		elements[i] = u32 + (uint32_t)base;
	}
	draw(x, st, mode, 0, (uint32_t)(count - begin), elements + begin, identity + (uint64_t)begin);
}

GLS_HANDLER(glPrimitiveRestartIndex, CLIENT) { st->client.restart_index = arg_u(c, 0); }
GLS_HANDLER(glPrimitiveRestartIndexNV, CLIENT) { st->client.restart_index = arg_u(c, 0); }

GLS_HANDLER(glDrawElements, ARRAY) { gls_draw_elements(x, st, arg_u(c, 0), arg_i(c, 1), arg_u(c, 2), arg(c, 3), 0); }
GLS_HANDLER(glDrawRangeElements, ARRAY)
{
	gls_draw_elements(x, st, arg_u(c, 0), arg_i(c, 3), arg_u(c, 4), arg(c, 5), 0);
}
GLS_HANDLER(glDrawElementsBaseVertex, ARRAY)
{
	gls_draw_elements(x, st, arg_u(c, 0), arg_i(c, 1), arg_u(c, 2), arg(c, 3), (int32_t)arg_i(c, 4));
}

GLS_HANDLER(glDrawRangeElementsBaseVertex, ARRAY)
{
	gls_draw_elements(x, st, arg_u(c, 0), arg_i(c, 3), arg_u(c, 4), arg(c, 5), (int32_t)arg_i(c, 6));
}

static void multi_draw_elements(struct gls_exec *x, struct gls_state *st, const struct call *c, int64_t stride,
                                const struct trace_value *base, uint64_t n_base)
{
	uint64_t n_count, n_indices;
	const struct trace_value *count = arg_items(c, 1, &n_count), *indices = arg_items(c, 3, &n_indices);

	for (uint64_t i = 0; i < n_count && i < n_indices; i++)
		gls_draw_elements(x, st, mode_of(c, i, stride), gls_value_int(&count[i]), arg_u(c, 2), &indices[i],
		                  i < n_base ? (int32_t)gls_value_int(&base[i]) : 0);
}

GLS_HANDLER(glMultiDrawElements, ARRAY) { multi_draw_elements(x, st, c, 0, NULL, 0); }
GLS_HANDLER(glMultiModeDrawElementsIBM, ARRAY) { multi_draw_elements(x, st, c, arg_i(c, 5), NULL, 0); }
GLS_HANDLER(glMultiDrawElementsBaseVertex, ARRAY)
{
	uint64_t n;
	const struct trace_value *base = arg_items(c, 5, &n);

	multi_draw_elements(x, st, c, 0, base, n);
}

/* ---- ArrayElement: the equivalent calls (sec. 2.8), executed or added to the list being compiled ---- */

static void put_call(struct gls_exec *x, struct gls_state *st, const char *name, const struct trace_value *args,
                     uint32_t n)
{
	const uint32_t command = (uint32_t)gls_command_find(name);
	struct call c = *x->call;

	c.args = args;
	c.n_args = n;
	if (!st->list || gls_list_append(x, st, &c, command) || st->list_mode != GL_COMPILE)
		x->dispatch(x, &c, command, NULL);
}

GLS_HANDLER(glArrayElement, CLIENT)
{
	static const char *const names[] = { "glNormal3fv", "glColor4fv", "glSecondaryColor3fv", "glFogCoordfv" };
	struct trace_value numbers[4], args[2];
	struct gls_sources s;
	float v[4];
	int has_vertex;

	/* Without positions it only sets current values. */
	has_vertex = st->client.arrays[GLS_ARRAY_VERTEX].enabled || st->client.arrays[GLS_ARRAY_GENERIC0].enabled;
	if (has_vertex ? !gls_sources_open(x, st, &s) : !gls_sources_open_attributes(x, st, &s))
		return;
	if (s.has_edges) {
		gls_source_read(&s.edge, arg_u(c, 0), v);
		args[0] = (struct trace_value){ .type = TRACE_UINT, .i = v[0] != 0 };
		put_call(x, st, "glEdgeFlag", args, 1);
	}
	args[1] = (struct trace_value){ .type = TRACE_ARRAY, .count = 4, .items = numbers };
	for (unsigned a = 0; a <= N_GLS_ATTRIBUTES; a++) {
		int is_vertex = a == N_GLS_ATTRIBUTES;
		if (is_vertex ? !has_vertex : !(s.present >> a & 1))
			continue;
		gls_source_read(is_vertex ? &s.vertex : &s.attributes[a], arg_u(c, 0), v);
		for (unsigned i = 0; i < 4; i++)
			numbers[i] = (struct trace_value){ .type = TRACE_FLOAT, .f = v[i] };
		args[0] = (struct trace_value){ .type = TRACE_ENUM, .i = GL_TEXTURE0 + a - GLS_ATTR_TEXCOORD };
		if (is_vertex) {
			put_call(x, st, "glVertex4fv", args + 1, 1);
			continue;
		}
		if (a >= GLS_ATTR_GENERIC) {
			args[0] = (struct trace_value){ .type = TRACE_UINT, .i = 1 + a - GLS_ATTR_GENERIC };
			put_call(x, st, "glVertexAttrib4fv", args, 2);
			continue;
		}
		if (a >= GLS_ATTR_TEXCOORD)
			put_call(x, st, "glMultiTexCoord4fv", args, 2);
		else
			put_call(x, st, names[a], args + 1, 1);
	}
}
