/*
 * vertex_packet: vertex for sixteen vertices of one instance at once, with bit-identical results. These are processed
 * one by one: materials that change from vertex to vertex, unclamped colours, generated coordinates, and normals whose
 * squares are not normal floats.
 */
#include "kernels/frame/pack/pack_light.h"
#include "kernels/gl/vertex.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/vertex_lanes.h"
#include "kernels/one_lanes.h"

/* Consecutive vertices. */
struct vertex_pack {
	__global const struct geometry *g;
	__global const struct scene_material *m;
	uint v; /* number of the first one in the mesh */
	struct vec4_16 eye, clip;
	struct vec3_16 normal;
};

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

/* Load and store four numbers of each vertex, `step` numbers apart. */
WIDE_VECTORS static inline void load_fours(__global const float *from, uint step, packf *row)
{
	pack_gather_from(from, as_uint16(PACK_LANES) * step, row);
}

WIDE_VECTORS static inline struct vec4_16 load_four(__global const float *from)
{
	packf row[4];

	load_fours(from, 4, row);
	return v4_16(row[0], row[1], row[2], row[3]);
}

WIDE_VECTORS static inline void store_fours(struct vec4_16 v, __global float *to, uint step)
{
	packf four[4];

	pack_turn_rows(v.x, v.y, v.z, v.w, four);
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		*(__global gather_loose *)(to + lane * step) = LANE(four[lane % 4], float4, lane / 4);
}

/* An attribute of the mesh, or the current value. */
WIDE_VECTORS static inline struct vec4_16 load_attribute(uint is_there, __global const float *array,
                                                         __global const float *current)
{
	return is_there ? load_four(array) : v4_same(v4_load(current));
}

/* --- Places ------------------------------------------------------------------------------------------------------ */

/* vertex_eye_normal for all lanes. @return the lanes whose normals are neither too short nor too long to square */
WIDE_VECTORS static inline packi load_normals(const struct tables *t, struct vertex_pack *p)
{
	struct vec3_16 n = v3_same(v3_load(t->currents[p->g->current].normal));
	packf row[4], length2, longest;

	/* three numbers each, loaded with the number before them: before the first normal, that is a position */
	if (p->g->attributes & SCENE_HAS_NORMAL) {
		load_fours(t->attributes + p->g->normal + p->v * 3 - 1, 3, row);
		n = v3_16(row[1], row[2], row[3]);
	}
	p->normal = vertex_turn_normal(p->g->normal_matrix, n);
	length2 = v3_dot(p->normal, p->normal);
	longest = fmax(fmax(fabs(p->normal.x), fabs(p->normal.y)), fabs(p->normal.z));
	if (p->m->normalize)
		p->normal = v3_normalize(p->normal);
	return (longest < FLT_MIN) | ((length2 >= FLT_MIN) & (length2 < INFINITY));
}

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/* light_vertex without visibility. */
WIDE_VECTORS static inline void light_side(const struct tables *t, const struct vertex_pack *p, int back,
                                           struct vec4_16 color, struct lit_16 *out)
{
	__global const struct scene_material *m = p->m;
	const struct vec3_16 normal = back ? v3_scale(p->normal, (packf)(-1)) : p->normal;
	struct matter_16 matter;

	light_material(m, &m->front, &m->back, back ? (packi)(-1) : (packi)(0), color, &matter, out);
	light_begin(m, v3_16(p->eye.x, p->eye.y, p->eye.z), normal, &matter, out);
	for (uint i = 0; i < m->light_count; i++)
		light_add(m, &matter, &t->lights[m->light_first + i], i, 0, out);
	light_end(m, &matter, out);
}

/* vertex_store_colors for all lanes. */
WIDE_VECTORS static inline void store_colors(const struct tables *t, const struct vertex_pack *p,
                                             __global struct shaded_vertex *to)
{
	__global const struct geometry *g = p->g;
	__global const struct scene_current *current = &t->currents[g->current];
	const int is_lit = p->m->lighting != 0, sides = is_lit && p->m->two_side ? 2 : 1,
		  is_shaded = !(p->m->surface.hidden & SCENE_UNSHADED);
	struct lit_16 lit[2];
	const struct vec4_16 color =
		load_attribute(g->attributes & SCENE_HAS_COLOR, t->attributes + g->color + p->v * 4, current->color);

	for (int side = 0; side < sides && is_lit; side++)
		light_side(t, p, side, color, &lit[side]);
	if (!is_lit) {
		lit[0].color = vertex_clamp(color, g->attributes & SCENE_HAS_COLOR);
		lit[0].secondary = vertex_clamp(load_attribute(g->attributes & SCENE_HAS_SECONDARY,
		                                               t->attributes + g->secondary + p->v * 4, current->secondary),
		                                g->attributes & SCENE_HAS_SECONDARY);
		lit[0].lights = 0;
	}
	for (int i = 0; i < 2; i++) {
		const struct lit_16 *l = &lit[i < sides ? i : 0];

		store_fours(l->color, to->color[i], sizeof(*to) / 4);
		store_fours(l->secondary, to->secondary[i], sizeof(*to) / 4);
		for (uint lane = 0; lane < PACK_SIZE; lane++)
			to[lane].lit[i] = is_shaded ? LANE(l->lights, const uint, lane) : 0;
	}
}

/* --- The rest ---------------------------------------------------------------------------------------------------- */

/* vertex_fog_distance, or the fog coordinate of the mesh, or the current one. */
WIDE_VECTORS static inline packf fog_coord(const struct tables *t, const struct vertex_pack *p)
{
	__global const struct geometry *g = p->g;

	if (p->m->fog_coord_source != GL_FOG_COORD)
		return vertex_fog_distance(p->m->fog_coord_source, p->eye);
	if (g->attributes & SCENE_HAS_FOG_COORD)
		return *(__global const pack_loose_floats *)(t->attributes + g->fog_coord + p->v);
	return t->currents[g->current].fog_coord;
}

/* Store a unit's coordinates if they are not generated. unit: the material's, number i */
WIDE_VECTORS static inline void store_coords(const struct tables *t, const struct vertex_pack *p, uint i,
                                             __global float *to)
{
	__global const struct scene_unit *unit = &t->units[p->m->unit_first + i];
	const struct vec4_16 coord = load_attribute(p->g->attributes & SCENE_HAS_TEXCOORD << unit->unit,
	                                            t->attributes + p->g->texcoord[unit->unit] + p->v * 4,
	                                            t->currents[p->g->current].texcoord[unit->unit]);

	store_fours(m4_mul(unit->matrix, coord), to + i * 4, p->m->unit_count * 4);
}

/* --- Sixteen vertices -------------------------------------------------------------------------------------------- */

/* Test whether packs support everything that a geometry and its material need. */
static inline int knows(const struct tables *t, __global const struct geometry *g)
{
	__global const struct scene_material *m = &t->materials[g->material];

	int known = !pack_refuses_vertices(m) && !(m->lighting && g->attributes & SCENE_HAS_FACE);

	for (uint i = 0; i < m->unit_count && known; i++)
		known = !pack_refuses_vertices_unit(&t->units[m->unit_first + i]);
	return known;
}

/*
 * Process vertices of one supported geometry. @return 0: a normal's square is not a normal float, and nothing is stored
 */
WIDE_VECTORS static inline int do_pack(const struct vertex_arguments *a, uint first, __global const struct geometry *g)
{
	const struct tables *t = &a->tables;
	const uint step = sizeof(struct shaded_vertex) / 4;
	__global struct shaded_vertex *out = &a->shaded[first];
	struct vertex_pack p = { .g = g, .m = &t->materials[g->material], .v = first - g->vertex_first };
	struct window_vertex_16 window;
	struct vec4_16 obj;
	packf size;

	if (any_pack(~load_normals(t, &p)))
		return 0;
	obj = load_four(t->attributes + g->position + p.v * 4);
	p.eye = m4_mul(g->eye_from_obj, obj);
	p.clip = m4_mul(g->clip_from_obj, obj);
	store_fours(p.clip, out->clip, step);
	store_fours(p.clip, a->clips + first * 4, 4);
	store_fours(p.eye, out->eye, step);
	window = clip_window(&a->views[g->view], p.clip, (float)a->height);
	store_fours(v4_16(as_float16(window.x), as_float16(window.y), window.z, window.w_inv),
	            (__global float *)&a->windows[first], 4);
	store_fours(v4_16(p.normal.x, p.normal.y, p.normal.z, fog_coord(t, &p)), out->normal, step);
	store_colors(t, &p, out);
	size = vertex_point_size(p.m, p.eye);
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		out[lane].size[0] = LANE(size, const float, lane);
		out[lane].size[1] = 0;
	}
	for (uint i = 0; i < p.m->unit_count; i++)
		store_coords(t, &p, i, a->coords + (g->texcoord_first + p.v * p.m->unit_count) * 4);
	return 1;
}

KERNEL_OF(float16) void vertex_packet(KERNEL_ARGUMENTS(vertex))
{
	const struct vertex_arguments a = KERNEL_STRUCT(vertex);
	const uint begin = (uint)get_global_id(0) * VERTEX_PACKET, end = min(begin + VERTEX_PACKET, n);

	for (uint first = begin; first < end;) {
		__global const struct geometry *g = &a.tables.geometries[owners[first]];
		const uint left = min(end, g->vertex_first + g->vertex_count) - first;
		const int is_done = left >= PACK_SIZE && knows(&a.tables, g) && do_pack(&a, first, g);

		for (uint i = 0; i < min(left, PACK_SIZE) && !is_done; i++)
			vertex_item(&a, first + i);
		first += min(left, PACK_SIZE);
	}
}
