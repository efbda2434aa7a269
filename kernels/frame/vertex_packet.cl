/*
 * vertex_packet: vertex for sixteen vertices of one instance at once, to the same bits. What packs do not know goes one
 * by one: materials that change from vertex to vertex, colours that are not clamped, coordinates that are generated,
 * and normals whose squares are no normal numbers.
 */
#include "kernels/frame/pack_light.h"
#include "kernels/gl/vertex.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/vertex_lanes.h"
#include "kernels/one_lanes.h"

/* Vertices that follow each other. */
struct vertex_pack {
	__global const struct geometry *g;
	__global const struct scene_material *m;
	uint v; /* of the first one, in the mesh */
	packf obj[4], eye[4], clip[4];
	struct vec3_16 normal;
};

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

/* Four numbers of each vertex, from and to where they stand, `step` numbers apart. */
WIDE_VECTORS static inline void load_fours(__global const float *from, uint step, packf *row)
{
	pack_gather_from(from, as_uint16(PACK_LANES) * step, row);
}

WIDE_VECTORS static inline void store_fours(packf x, packf y, packf z, packf w, __global float *to, uint step)
{
	packf four[4];

	pack_turn_rows(x, y, z, w, four);
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		*(__global gather_loose *)(to + lane * step) = LANE(four[lane % 4], float4, lane / 4);
}

/* An attribute of the mesh, or the current one. */
WIDE_VECTORS static inline void load_attribute(uint is_there, __global const float *array,
                                               __global const float *current, packf *row)
{
	if (is_there)
		load_fours(array, 4, row);
	for (int i = 0; i < 4 && !is_there; i++)
		row[i] = current[i];
}

/* As m4_mul. */
WIDE_VECTORS static inline void transform(__global const float *m, const packf *v, packf *out)
{
	for (int i = 0; i < 4; i++)
		out[i] = m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i] * v[3];
}

/* --- Places ------------------------------------------------------------------------------------------------------ */

/* As vertex_eye_normal, in the lanes that it returns: those whose normals are not too short to square, or too long. */
WIDE_VECTORS static inline packi load_normals(const struct tables *t, struct vertex_pack *p)
{
	__global const float *r = p->g->normal_matrix, *current = t->currents[p->g->current].normal;
	packf n[4], length2, longest;

	for (int i = 0; i < 3; i++)
		n[1 + i] = current[i];
	if (p->g->attributes & SCENE_HAS_NORMAL) /* three numbers each, and what stands before them: positions do before
	                                            the first */
		load_fours(t->attributes + p->g->normal + p->v * 3 - 1, 3, n);
	p->normal = v3_16(r[0] * n[1] + r[1] * n[2] + r[2] * n[3], r[4] * n[1] + r[5] * n[2] + r[6] * n[3],
	                     r[8] * n[1] + r[9] * n[2] + r[10] * n[3]);
	length2 = v3_dot(p->normal, p->normal);
	longest = fmax(fmax(fabs(p->normal.x), fabs(p->normal.y)), fabs(p->normal.z));
	if (p->m->normalize)
		p->normal = v3_normalize(p->normal);
	return (longest < FLT_MIN) | ((length2 >= FLT_MIN) & (length2 < INFINITY));
}

/* As clip_outside: whether it lies beyond any plane. */
WIDE_VECTORS static inline packi is_outside(const packf *c)
{
	return ~((c[0] <= c[3]) & (c[0] + c[3] >= 0.0f) & (c[1] <= c[3]) & (c[1] + c[3] >= 0.0f) &
	         (c[2] + c[3] >= 0.0f) & (c[2] <= c[3]));
}

/* As clip_window. */
WIDE_VECTORS static inline void store_window(__global const struct view *view, const packf *clip, float height,
                                             __global struct window_vertex *to)
{
	const float near = view->depth_range[0], far = view->depth_range[1], half_x = view->viewport[2] * 0.5f,
		    half_y = view->viewport[3] * 0.5f;
	const packf w_inv = 1.0f / clip[3];
	const packf x = fma((packf)(half_x), clip[0] * w_inv, (packf)(view->viewport[0] + half_x));
	const packf y = fma((packf)(-half_y), clip[1] * w_inv, (packf)(height - (view->viewport[1] + half_y)));
	const packf z = fma((packf)((far - near) * 0.5f), clip[2] * w_inv, (packf)((far + near) * 0.5f));
	const packi is_there = (clip[3] > 0.0f) & ~is_outside(clip) & (fabs(x) < CLIP_SAFE_PIXELS) &
	                       (fabs(y) < CLIP_SAFE_PIXELS);
	const packi at_x = convert_int16(pack_round((x - 0.5f) * 256.0f)) + 128;
	const packi at_y = (int)height * 256 - (convert_int16(pack_round((y - 0.5f) * 256.0f)) + 128);
	const packf none = 0.0f;

	store_fours(select(none, as_float16(at_x), is_there), select(none, as_float16(at_y), is_there),
	            select(none, z, is_there), select(none, w_inv, is_there), (__global float *)to, 4);
}

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/* light_vertex without visibility */
WIDE_VECTORS static inline void light_side(const struct tables *t, const struct vertex_pack *p, int back,
                                           struct vec4_16 color, struct lit_16 *out)
{
	__global const struct scene_material *m = p->m;
	const struct vec3_16 normal = back ? v3_scale(p->normal, (packf)(-1)) : p->normal;
	struct matter_16 matter;

	light_material(m, &m->front, &m->back, back ? (packi)(-1) : (packi)(0), color, &matter, out);
	light_begin(m, v3_16(p->eye[0], p->eye[1], p->eye[2]), normal, &matter, out);
	for (uint i = 0; i < m->light_count; i++)
		light_add(m, &matter, &t->lights[m->light_first + i], i, 0, out);
	light_end(m, &matter, out);
}

/* As vertex_store_colors. */
WIDE_VECTORS static inline void store_colors(const struct tables *t, const struct vertex_pack *p,
                                             __global struct shaded_vertex *to)
{
	__global const struct geometry *g = p->g;
	__global const struct scene_current *current = &t->currents[g->current];
	const int is_lit = p->m->lighting != 0, sides = is_lit && p->m->two_side ? 2 : 1,
		  is_shaded = !(p->m->surface.hidden & SCENE_UNSHADED);
	struct lit_16 lit[2];
	packf color[4], secondary[4];

	load_attribute(g->attributes & SCENE_HAS_COLOR, t->attributes + g->color + p->v * 4, current->color, color);
	for (int side = 0; side < sides && is_lit; side++)
		light_side(t, p, side, v4_16(color[0], color[1], color[2], color[3]), &lit[side]);
	if (!is_lit) {
		load_attribute(g->attributes & SCENE_HAS_SECONDARY, t->attributes + g->secondary + p->v * 4,
		               current->secondary, secondary);
		lit[0].color = vertex_clamp(v4_16(color[0], color[1], color[2], color[3]), g->attributes & SCENE_HAS_COLOR);
		lit[0].secondary = vertex_clamp(v4_16(secondary[0], secondary[1], secondary[2], secondary[3]),
		                                g->attributes & SCENE_HAS_SECONDARY);
		lit[0].lights = 0;
	}
	for (int i = 0; i < 2; i++) {
		const struct lit_16 *l = &lit[i < sides ? i : 0];

		store_fours(l->color.x, l->color.y, l->color.z, l->color.w, to->color[i], sizeof(*to) / 4);
		store_fours(l->secondary.x, l->secondary.y, l->secondary.z, l->secondary.w, to->secondary[i],
		            sizeof(*to) / 4);
		for (uint lane = 0; lane < PACK_SIZE; lane++)
			to[lane].lit[i] = is_shaded ? LANE(l->lights, const uint, lane) : 0;
	}
}

/* --- The rest ---------------------------------------------------------------------------------------------------- */

/* As vertex_fog_distance, or the mesh's or the current fog coordinate. */
WIDE_VECTORS static inline packf fog_coord(const struct tables *t, const struct vertex_pack *p)
{
	__global const struct geometry *g = p->g;
	const packf x = p->eye[0], y = p->eye[1], z = p->eye[2];

	switch (p->m->fog_coord_source) {
	case GL_FOG_COORD:
		if (g->attributes & SCENE_HAS_FOG_COORD)
			return *(__global const pack_loose_floats *)(t->attributes + g->fog_coord + p->v);
		return t->currents[g->current].fog_coord;
	case GL_EYE_RADIAL_NV: return sqrt(z * z + y * y + x * x);
	case GL_EYE_PLANE: return z;
	default: return fabs(z);
	}
}

/* As vertex_point_size. */
WIDE_VECTORS static inline packf point_size(const struct vertex_pack *p)
{
	__global const struct scene_material *m = p->m;
	const packf d = fabs(p->eye[2]),
		    fade = m->point_attenuation[0] + d * (m->point_attenuation[1] + d * m->point_attenuation[2]);
	const packf one = m->point_size, size = select(one, one * sqrt(1.0f / fade), (fade != 1.0f) & (fade > 0.0f)),
		    low = m->point_size_min;
	const packf at_least = select(low, size, size > low), high = m->point_size_max;

	return select(high, at_least, at_least < high);
}

/* Where a unit's coordinates are not generated. unit: the material's, number i */
WIDE_VECTORS static inline void store_coords(const struct tables *t, const struct vertex_pack *p, uint i,
                                             __global float *to)
{
	__global const struct scene_unit *unit = &t->units[p->m->unit_first + i];
	packf coord[4], out[4];

	load_attribute(p->g->attributes & SCENE_HAS_TEXCOORD << unit->unit,
	               t->attributes + p->g->texcoord[unit->unit] + p->v * 4,
	               t->currents[p->g->current].texcoord[unit->unit], coord);
	transform(unit->matrix, coord, out);
	store_fours(out[0], out[1], out[2], out[3], to + i * 4, p->m->unit_count * 4);
}

/* --- Sixteen vertices -------------------------------------------------------------------------------------------- */

/* Whether packs know all that a geometry and its material ask for. */
static inline int knows(const struct tables *t, __global const struct geometry *g)
{
	__global const struct scene_material *m = &t->materials[g->material];

	if (m->unclamped & 2u || (m->lighting && g->attributes & SCENE_HAS_FACE))
		return 0;
	for (uint i = 0; i < m->unit_count; i++)
		for (int c = 0; c < 4; c++)
			if (t->units[m->unit_first + i].gen_mode[c])
				return 0;
	return 1;
}

/* Vertices of one geometry that packs know. @return 0: a normal's square is no normal number, nothing is stored */
WIDE_VECTORS static inline int do_pack(const struct vertex_arguments *a, uint first, __global const struct geometry *g)
{
	const struct tables *t = &a->tables;
	const uint step = sizeof(struct shaded_vertex) / 4;
	__global struct shaded_vertex *out = &a->shaded[first];
	struct vertex_pack p = { .g = g, .m = &t->materials[g->material], .v = first - g->vertex_first };
	packf fog, size;

	if (any_pack(~load_normals(t, &p)))
		return 0;
	load_fours(t->attributes + g->position + p.v * 4, 4, p.obj);
	transform(g->eye_from_obj, p.obj, p.eye);
	transform(g->clip_from_obj, p.obj, p.clip);
	store_fours(p.clip[0], p.clip[1], p.clip[2], p.clip[3], out->clip, step);
	store_fours(p.clip[0], p.clip[1], p.clip[2], p.clip[3], a->clips + first * 4, 4);
	store_fours(p.eye[0], p.eye[1], p.eye[2], p.eye[3], out->eye, step);
	store_window(&a->views[g->view], p.clip, (float)a->height, &a->windows[first]);
	fog = fog_coord(t, &p);
	store_fours(p.normal.x, p.normal.y, p.normal.z, fog, out->normal, step);
	store_colors(t, &p, out);
	size = point_size(&p);
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
