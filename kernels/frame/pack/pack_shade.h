/*
 * Colours of sixteen fragments of one material at once: what shade_item does for one, in the same order of operations
 * and with bit-identical results. OpenCL C only. pack_is_plain tests which materials are supported; shade_item handles
 * the others.
 */
#pragma once

#include "kernels/frame/pack/pack_blend.h"
#include "kernels/frame/pack/pack_encode.h"
#include "kernels/frame/pack/pack_light.h"
#include "kernels/frame/pack/pack_sample.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/finish_lanes.h"
#include "kernels/one_lanes.h"

/* Test whether pack_shade supports everything that a material needs. */
static inline int pack_is_plain(const struct shade_arguments *a, __global const struct scene_material *m)
{
	int plain = !pack_refuses_shade(m) &&
	            (a->transport == TRANSPORT_GL || a->transport == TRANSPORT_DIFFUSE || stage_is_path(a->transport));

	for (uint i = 0; i < m->unit_count && plain; i++)
		plain = pack_knows_texture(&a->tables, &a->tables.units[m->unit_first + i]) &&
		        pack_has_sources(m, a->tables.units + m->unit_first, i);
	return plain;
}

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/* Interpolate the vertices' primary or secondary colours; under flat shading, take the last vertex's. four: PACK_COLOR
 * or PACK_SECONDARY */
WIDE_VECTORS static inline struct vec4_16 pack_between(const struct tables *t, const struct pack *p, uint four)
{
	const packu row = four + as_uint16(pack_side(p) & 1);
	struct vec4_16 v[3];

	v[2] = pack_vertex4(t, p, 2, row);
	if (p->material->shade_model == GL_FLAT)
		return v[2];
	v[0] = pack_vertex4(t, p, 0, row);
	v[1] = pack_vertex4(t, p, 1, row);
	return v4_between(v[0], v[1], v[2], p->weight);
}

/* point_lit_from_vertices for all lanes; secondary colours only if they are used. */
WIDE_VECTORS static inline void pack_lit_from_vertices(const struct tables *t, const struct pack *p,
                                                       struct vec4_16 *color, struct vec4_16 *secondary)
{
	*color = *secondary = pack_between(t, p, PACK_COLOR);
	if (p->material->color_sum || (p->material->lighting && p->material->separate_specular))
		*secondary = pack_between(t, p, PACK_SECONDARY);
}

/* A bit for each light that lights a vertex. */
WIDE_VECTORS static inline packu pack_lights(const struct tables *t, const struct pack *p)
{
	const packi back = pack_side(p);
	packf v[4];
	packu lights;

	pack_vertex(t, p, 2, (packu)(PACK_LIT), v);
	lights = as_uint16(select(v[0], v[1], back));
	for (int k = 0; k < 2 && p->material->shade_model != GL_FLAT; k++) {
		pack_vertex(t, p, k, (packu)(PACK_LIT), v);
		lights |= as_uint16(select(v[0], v[1], back));
	}
	return lights;
}

/* The cache entry for a lane's triangle. is_lit: receives 1 if it was already lit with the visibility seen there */
static inline struct pack_lit *pack_keep_lit(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                             uint lane, const struct vec3 *seen, struct pack_kept *kept, int *is_lit)
{
	struct pack_lit *l = &kept->lit[list->primitive[lane] % SHADE_TRIANGLES];
	const int front = LANE(p->front, const int, lane) != 0;
	int same = l->instance == list->instance[lane] && l->primitive == list->primitive[lane] && l->p.front == front;

	if (!same) {
		l->instance = list->instance[lane];
		l->primitive = list->primitive[lane];
		point_vertices(t, &l->p, l->instance, l->primitive & ~FRAGMENT_PERSPECTIVE);
		l->p.front = front;
	}
	for (uint i = 0; i < SCENE_MAX_LIGHTS; i++) {
		same = same && seen[i].x == l->seen[i].x && seen[i].y == l->seen[i].y && seen[i].z == l->seen[i].z;
		l->seen[i] = seen[i];
	}
	*is_lit = same;
	return l;
}

/* The lanes' vertices, lit one by one. */
struct pack_corners_lit {
	struct vec4_16 color[3], secondary[3];
};

static inline void pack_take_lit(const struct lit *lit, int flat, uint lane, struct pack_corners_lit *to)
{
	for (uint k = flat ? 2 : 0; k < 3; k++) {
		v4_put_lane(lit[k].color, lane, &to->color[k]);
		v4_put_lane(lit[k].secondary, lane, &to->secondary[k]);
	}
}

/* pack_between of vertices that were lit again. lit: their colours */
WIDE_VECTORS static inline struct vec4_16 pack_between_again(const struct pack *p, const struct vec4_16 *lit)
{
	return p->material->shade_model == GL_FLAT ? lit[2] : v4_between(lit[0], lit[1], lit[2], p->weight);
}

/* Light each lane's triangle again with the lights' visibility, as in setup_keep_lit. */
static inline void pack_light_again(const struct shade_arguments *a, const struct pack_list *list,
                                    const struct pack *p, uint lanes, struct pack_kept *kept,
                                    struct pack_corners_lit *lit)
{
	const struct vec4_16 none = v4_16(0, 0, 0, 0);

	for (int k = 0; k < 3; k++)
		lit->color[k] = lit->secondary[k] = none;
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		struct vec3 seen[SCENE_MAX_LIGHTS];
		struct pack_lit *l;
		int is_lit;

		stage_seen(a->visibility, a->n_slots, a->n, list->item[lane], seen);
		l = pack_keep_lit(&a->tables, list, p, lane, seen, kept, &is_lit);
		if (!is_lit)
			point_light_corners(&a->tables, &l->p, seen, l->lit);
		pack_take_lit(l->lit, p->material->shade_model == GL_FLAT, lane, lit);
	}
}

/* Texture samples at the fragments, and fog. */
struct pack_texturing {
	struct vec4_16 sample[SCENE_MAX_UNITS]; /* indexed by GL's unit number */
	packf fog;
};

/* Start of the texture coordinates of the lanes' meshes. is_uniform: all lanes are in the same triangle */
static inline packu pack_texcoord_first(const struct tables *t, const struct pack_list *list,
                                        __global const struct scene_material *m, uint lanes, int is_uniform)
{
	packu first = 0;

	if (is_uniform)
		return t->geometries[list->instance[popcount((lanes & -lanes) - 1)]].texcoord_first;
	for (uint lane = 0; lane < PACK_SIZE && m->unit_count; lane++) {
		const uint from = lanes >> lane & 1 ? lane : popcount((lanes & -lanes) - 1);

		LANE(first, uint, lane) = t->geometries[list->instance[from]].texcoord_first;
	}
	return first;
}

/* point_fog for materials that satisfy pack_is_plain. */
WIDE_VECTORS static inline packf pack_fog(const struct tables *t, const struct pack *p)
{
	__global const struct scene_material *m = p->material;
	packf v[3][4], c;

	if (!m->fog)
		return 1.0f;
	for (int k = 0; k < 3; k++)
		pack_vertex(t, p, k, (packu)(PACK_NORMAL), v[k]);
	c = v[0][3] * p->weight[0] + v[1][3] * p->weight[1] + v[2][3] * p->weight[2];
	return fog_linear(m, c);
}

/*
 * Replace the numbers at the lanes' vertices by those at their parts' corners. row: [3][4]. differ: lanes of one part
 * may have different numbers
 */
WIDE_VECTORS static inline void pack_cut_rows(const struct shade_arguments *a, const struct pack_list *list,
                                              const struct pack *p, uint lanes, struct pack_kept *kept, int differ,
                                              packf (*row)[4])
{
	for (uint left = lanes & pack_bits(p->cut), same; left; left &= ~same) {
		const uint lane = popcount((left & -left) - 1);

		same = differ ? 1u << lane : pack_same_part(list, p, left);
		pack_cut_row(pack_polygon(a, list, p, lane, kept), lane, pack_mask(same), p, row);
	}
}

/* Pixel positions for planes: from clip_origin, y from the top; and w there. */
struct pack_places {
	packf x, y, w;
};

WIDE_VECTORS static inline struct pack_places pack_places(const struct pack *p)
{
	const float middle = 0.5f - clip_origin(p->view);
	const struct pack_plane w_inv = pack_plane_through(&p->edges, p->w_inv);
	struct pack_places at;

	at.x = convert_float16(p->x) + middle;
	at.y = convert_float16(p->row) + middle;
	at.w = 1.0f / pack_plane_at(&w_inv, at.x, at.y);
	return at;
}

/* Numbers n to m of rows, interpolated by planes. row: values at the corners */
WIDE_VECTORS static inline void pack_by_planes(const struct pack *p, const struct pack_places *at, packf (*row)[4],
                                               int n, int m, packf *to)
{
	for (int c = n; c <= m; c++) {
		const packf over_w[3] = { row[0][c] * p->w_inv[0], row[1][c] * p->w_inv[1], row[2][c] * p->w_inv[2] };
		const struct pack_plane plane = pack_plane_through(&p->edges, over_w);

		to[c - n] = pack_plane_at(&plane, at->x, at->y) * at->w;
	}
}

/* A colour of the lanes' corners k, as pack_color_by_planes takes it. */
WIDE_VECTORS static inline void pack_corner_color(const struct shade_arguments *a, const struct pack *p, int k,
                                                  uint four, const struct vec4_16 *again, packf *row)
{
	if (!again) {
		pack_vertex(&a->tables, p, k, four + as_uint16(pack_side(p) & 1), row);
		return;
	}
	row[0] = again[k].x;
	row[1] = again[k].y;
	row[2] = again[k].z;
	row[3] = again[k].w;
}

/* A bit for each lane whose primary or secondary colour llvmpipe interpolates. color: SCENE_HAS_COLOR .. */
static inline packi pack_interpolated(const struct pack *p, uint color)
{
	if (p->material->shade_model == GL_FLAT || p->material->lighting || p->material->vertex_program)
		return point_interpolated(p->material, 0) & color ? -1 : 0;
	return (p->attributes & color * GEOMETRY_GIVEN) != 0;
}

/*
 * A colour between lit vertices, by planes where it is interpolated. four: PACK_COLOR or PACK_SECONDARY. again: this
 * colour of vertices that were lit again; 0: as they were lit first
 */
WIDE_VECTORS static inline struct vec4_16 pack_color_by_planes(const struct shade_arguments *a,
                                                               const struct pack_list *list, const struct pack *p,
                                                               uint lanes, struct pack_kept *kept, uint four,
                                                               const struct vec4_16 *again)
{
	const packi by_planes = pack_interpolated(p, four == PACK_COLOR ? SCENE_HAS_COLOR : SCENE_HAS_SECONDARY);
	struct vec4_16 color, between;
	packf row[3][4], at_pixel[4];
	struct pack_places at;

	if (any_pack(~by_planes))
		between = again ? pack_between_again(p, again) : pack_between(&a->tables, p, four);
	if (!any_pack(by_planes))
		return between;
	at = pack_places(p);
	for (int k = 0; k < 3; k++)
		pack_corner_color(a, p, k, four, again, row[k]);
	pack_cut_rows(a, list, p, lanes, kept, again != 0, row);
	pack_by_planes(p, &at, row, 0, 3, at_pixel);
	color = v4_16(at_pixel[0], at_pixel[1], at_pixel[2], at_pixel[3]);
	return any_pack(~by_planes) ? v4_choose(by_planes, color, between) : color;
}

/* point_lit_by_planes for all lanes; secondary colours only if they are used. */
WIDE_VECTORS static inline void pack_lit_by_planes(const struct shade_arguments *a, const struct pack_list *list,
                                                   const struct pack *p, uint lanes, struct pack_kept *kept,
                                                   const struct pack_corners_lit *again, struct vec4_16 *color,
                                                   struct vec4_16 *secondary)
{
	*color = *secondary = pack_color_by_planes(a, list, p, lanes, kept, PACK_COLOR, again ? again->color : 0);
	if (p->material->color_sum || (p->material->lighting && p->material->separate_specular))
		*secondary = pack_color_by_planes(a, list, p, lanes, kept, PACK_SECONDARY, again ? again->secondary : 0);
}

/* Texture coordinates of the material's unit i at the corners. first: pack_texcoord_first; texcoord: [3][4] */
WIDE_VECTORS static inline void pack_texcoords(const struct shade_arguments *a, const struct pack_list *list,
                                               const struct pack *p, uint lanes, packu first, uint i,
                                               struct pack_kept *kept, packf (*texcoord)[4])
{
	for (int k = 0; k < 3; k++)
		pack_row(a->tables.texcoords, p, first + p->number[k] * p->material->unit_count + i, texcoord[k]);
	pack_cut_rows(a, list, p, lanes, kept, 0, texcoord);
}

WIDE_VECTORS static inline void pack_texture(const struct shade_arguments *a, const struct pack_list *list,
                                             struct pack *p, uint lanes, struct pack_kept *kept,
                                             struct pack_texturing *out)
{
	const struct tables *t = &a->tables;
	__global const struct scene_material *m = p->material;
	const float middle = 0.5f - clip_origin(p->view);
	const packu first = pack_texcoord_first(t, list, m, lanes, p->uniform);

	for (uint i = 0; i < m->unit_count; i++) {
		__global const struct scene_unit *unit = &t->units[m->unit_first + i];
		packf texcoord[3][4], c[4];

		pack_texcoords(a, list, p, lanes, first, i, kept, texcoord);
		pack_sample(t, unit, &p->edges, p->w_inv, texcoord, p->x, p->row, middle, pack_mask(lanes), c);
		out->sample[unit->unit] = v4_16(c[0], c[1], c[2], c[3]);
	}
	out->fog = pack_fog(t, p);
}

WIDE_VECTORS static inline struct vec4_16 pack_finish_without(const struct tables *t, const struct pack *p,
                                                              const struct pack_texturing *texturing,
                                                              const struct vec4_16 *lit,
                                                              const struct vec4_16 *secondary, packf fog, uint without)
{
	const struct lit_16 both = { .color = *lit, .secondary = *secondary };

	return finish_in_fog(t, p->material, texturing->sample, &both, fog, without);
}

/* point_finish for all lanes. */
WIDE_VECTORS static inline struct vec4_16 pack_finish(const struct tables *t, const struct pack *p,
                                                      const struct pack_texturing *texturing, const struct vec4_16 *lit,
                                                      const struct vec4_16 *secondary)
{
	return pack_finish_without(t, p, texturing, lit, secondary, texturing->fog, 0);
}

/* point_finish_relit for all lanes. */
WIDE_VECTORS static inline struct vec4_16 pack_finish_relit(const struct tables *t, const struct pack *p,
                                                            const struct pack_texturing *texturing,
                                                            const struct vec4_16 *lit, const struct vec4_16 *secondary)
{
	return pack_finish_without(t, p, texturing, lit, secondary, texturing->fog, p->material->surface.light_unit);
}

/* The colour that point_albedo_of starts from. from_vertices: colours as lit at the vertices */
static inline struct vec4_16 pack_matte(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                        uint lanes, const struct vec4_16 *from_vertices)
{
	__global const struct scene_material *m = p->material;
	const uint mode = m->color_material_mode;
	struct vec4_16 v[3];

	if (!m->lighting)
		return m->surface.light_unit == SCENE_LIGHT_IN_COLORS ? pack_matte_color(t, list, p, lanes) :
		                                                        *from_vertices;
	if (!(m->color_material && (mode == GL_DIFFUSE || mode == GL_AMBIENT_AND_DIFFUSE)))
		return v4_clamp01(
			v4_choose(pack_side(p), v4_same(v4_load(m->back.diffuse)), v4_same(v4_load(m->front.diffuse))));
	pack_vertex_colors(t, list, p, lanes, v);
	return v4_clamp01(v4_between(v[0], v[1], v[2], p->weight));
}

/* point_albedo_of for all lanes. */
static inline struct vec4_16 pack_albedo(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                         uint lanes, const struct pack_texturing *texturing,
                                         const struct vec4_16 *from_vertices)
{
	const struct vec4_16 matte = pack_matte(t, list, p, lanes, from_vertices), none = v4_16(0, 0, 0, 0);

	return pack_finish_without(t, p, texturing, &matte, &none, (packf)(1), p->material->surface.light_unit);
}

/* --- Light that is followed -------------------------------------------------------------------------------------- */

/* Test whether lighting affects the colour of a material's points. pack_knows_geometry holds for their geometries. */
static inline int pack_takes_light(__global const struct scene_material *m)
{
	return (m->lighting || m->surface.relit) && !(m->surface.hidden & SCENE_UNSHADED);
}

/* stage_radiant_lights for all lanes. */
static inline packu pack_radiant_lights(const struct tables *t, const struct pack *p, const struct pack_surface *s)
{
	__global const struct scene_material *m = p->material;
	__global const struct scene_light *light = t->lights + (m->surface.relit ? m->surface.light_first : m->light_first);
	const uint count = m->surface.relit ? m->surface.light_count : m->light_count;
	const struct vec3_16 n = pack_normal(t, p, s), at = pack_place_at(s, p->weight);
	packu lights = 0;

	for (uint i = 0; i < count && pack_takes_light(m); i++) {
		struct vec3_16 to_light;
		packf strength;

		if (!(light[i].radius >= 0.0f))
			continue;
		strength = light_strength(&light[i], at, &to_light);
		lights |= select((packu)(0), (packu)(1u << i), (strength > 0.0f) & (v3_dot(n, to_light) > 0.0f));
	}
	return lights;
}

/*
 * stage_radiance for all lanes. from_vertices, secondary: colours as lit at the vertices. albedo: receives point_albedo
 * as light, if lighting affects the material
 */
static inline struct vec3_16 pack_radiance(const struct shade_arguments *a, const struct pack_list *list,
                                           const struct pack *p, const struct pack_surface *s, uint lanes,
                                           const struct pack_texturing *texturing, const struct vec4_16 *from_vertices,
                                           const struct vec4_16 *secondary, struct vec3_16 *albedo)
{
	const struct tables *t = &a->tables;
	__global const struct scene_material *m = p->material;
	__global const struct scene_light *light = t->lights + (m->surface.relit ? m->surface.light_first : m->light_first);
	const uint count = m->surface.relit ? m->surface.light_count : m->light_count;
	const struct vec3 by_rule = stage_light(a->transport, v3_load(m->surface.emission));
	const struct vec3 front = stage_light(a->transport, v3_load(m->front.emission)),
			  back = stage_light(a->transport, v3_load(m->back.emission));
	struct vec3_16 sum = v3_16(0, 0, 0), n, at;
	struct vec4_16 c;

	if (!pack_takes_light(m)) {
		c = pack_finish(t, p, texturing, from_vertices, secondary);
		return stage_light(a->transport, v3_add(v3_16(c.x, c.y, c.z), v3_same(v3_load(m->surface.emission))));
	}
	n = pack_normal(t, p, s);
	at = pack_place_at(s, p->weight);
	for (uint i = 0; i < count; i++) {
		struct vec3_16 to_light, sent;
		const packf strength = light_strength(&light[i], at, &to_light), cosine = v3_dot(n, to_light);

		sent = v3_scale(stage_light(a->transport, v3_scale(v3_same(v3_load(light[i].diffuse)), strength)),
		                cosine);
		sum = v3_choose(cosine > 0.0f, v3_add(sum, v3_mul(sent, pack_seen(a, list, lanes, i))), sum);
	}
	c = pack_albedo(t, list, p, lanes, texturing, from_vertices);
	*albedo = stage_light(a->transport, v3_16(c.x, c.y, c.z));
	sum = v3_add(v3_mul(sum, *albedo), v3_same(by_rule));
	return m->lighting ? v3_add(v3_choose(pack_side(p), v3_same(back), v3_same(front)), sum) : sum;
}

/* --- Shading ----------------------------------------------------------------------------------------------------- */

static inline void pack_store_relit(__global struct shaded *out, uint lane, const struct vec4_16 *color,
                                    const struct vec4_16 *direct)
{
	const struct vec4 c = v4_lane(color, lane), d = v4_lane(direct, lane);

	v3_store(out->shadowed, v3(c.x, c.y, c.z));
	stage_store_direct(out, v3(d.x, d.y, d.z));
}

/* pack_direct for light transport. from_vertices, secondary: colours as lit at the vertices */
static inline struct vec4_16 pack_direct_light(const struct shade_arguments *a, const struct pack_list *list,
                                               const struct pack *p, uint lanes, const struct pack_texturing *texturing,
                                               const struct vec4_16 *from_vertices, const struct vec4_16 *secondary,
                                               packu *lights)
{
	struct pack_surface s;
	struct vec3_16 sum;
	struct vec3_16 albedo;

	pack_surface(&a->tables, p, &s);
	*lights = pack_radiant_lights(&a->tables, p, &s);
	sum = stage_number(a->transport,
	                   pack_radiance(a, list, p, &s, lanes, texturing, from_vertices, secondary, &albedo));
	return v4_16(sum.x, sum.y, sum.z, 0);
}

/*
 * stage_relit with the emission. color: from GL's own lighting. lights: of the vertices; receives the lights of the
 * points if rules relight them
 */
static inline struct vec4_16 pack_direct(const struct shade_arguments *a, const struct pack_list *list,
                                         const struct pack *p, uint lanes, const struct pack_texturing *texturing,
                                         const struct vec4_16 *color, packu *lights)
{
	__global const struct scene_material *m = p->material;
	struct vec4_16 out = *color;
	struct lit_16 here;
	struct pack_surface s;

	if (m->surface.relit) {
		pack_surface(&a->tables, p, &s);
		pack_lit_here(a, list, p, &s, lanes, &here);
		out = pack_finish_relit(&a->tables, p, texturing, &here.color, &here.secondary);
		*lights = here.lights;
	}
	return v4_16(out.x + m->surface.emission[0], out.y + m->surface.emission[1], out.z + m->surface.emission[2],
	             out.w);
}

/*
 * shade_item for fragments of one plain material, and of geometries that satisfy pack_knows_geometry.
 * @return the lanes that are done: none in slivers
 */
static inline uint pack_shade(const struct shade_arguments *a, const struct pack_list *list, uint lanes,
                              struct pack_kept *kept)
{
	const struct tables *t = &a->tables;
	__global const struct geometry *g = &t->geometries[list->instance[popcount((lanes & -lanes) - 1)]];
	__global const struct scene_material *m = &t->materials[g->material];
	struct vec4_16 from_vertices, secondary, color, direct, albedo;
	struct pack_corners_lit again;
	struct pack_texturing texturing;
	struct pack *p = &kept->last;
	packu lights;

	p->material = m;
	p->view = &a->views[g->view];
	lanes = pack_place(a, list, lanes, a->n_slots == 0, kept, p);
	if (!lanes)
		return 0;
	pack_texture(a, list, p, lanes, kept, &texturing);
	if (a->n_slots && !m->surface.relit) {
		pack_light_again(a, list, p, lanes, kept, &again);
		pack_lit_by_planes(a, list, p, lanes, kept, &again, &from_vertices, &secondary);
	} else {
		pack_lit_by_planes(a, list, p, lanes, kept, 0, &from_vertices, &secondary);
	}
	color = pack_finish(t, p, &texturing, &from_vertices, &secondary);
	color = v4_16(pixel_nudge(color.x), pixel_nudge(color.y), pixel_nudge(color.z), color.w);
	lights = pack_lights(t, p);
	direct = stage_is_path(a->transport) ?
	                 pack_direct_light(a, list, p, lanes, &texturing, &from_vertices, &secondary, &lights) :
	                 pack_direct(a, list, p, lanes, &texturing, &color, &lights);
	for (uint left = a->n_slots ? lanes : 0; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		pack_store_relit(&a->shaded[list->item[lane]], lane, &color, &direct);
	}
	if (a->n_slots)
		return lanes;
	albedo = v4_16(0, 0, 0, 0);
	if (a->albedo)
		albedo = pack_albedo(t, list, p, lanes, &texturing, &from_vertices);
	lights = (lights & 255) * SHADED_WANTS(0) | SHADED_THERE | (as_uint16(p->front) & SHADED_FRONT);
	for (uint left = lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		__global struct shaded *out = &a->shaded[list->item[lane]];
		__global struct fragment *f = &a->fragments[list->item[lane]];
		struct vec4 of;

		f->b1 = LANE(p->b1, float, lane);
		f->b2 = LANE(p->b2, float, lane);
		f->depth = out->depth = LANE(p->depth, float, lane);
		pack_store_relit(out, lane, &color, &direct);
		v4_store(out->gl, v4_lane(&color, lane));
		of = v4_lane(&albedo, lane);
		v3_store(out->albedo, v3(of.x, of.y, of.z));
		out->flags = LANE(lights, uint, lane);
	}
	return lanes;
}
