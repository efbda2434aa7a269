/*
 * Lights sixteen points of one material per point (Phong 1975) instead of interpolating between lit vertices. This is
 * point_lit_here for packs, from the same text (light_lanes.h). OpenCL C only.
 *
 * Each function takes a set of lanes, a bit for each.
 */
#pragma once

#include "kernels/frame/pack/pack_combine.h"
#include "kernels/frame/pack/pack_surface.h"
#include "kernels/gl/light.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/light_lanes.h"
#include "kernels/one_lanes.h"

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/*
 * The current colours (glColor) at the three vertices of each lane's triangle. Lanes outside the set, which has at
 * least one, repeat its first lane's triangle (pack_load_triangles); their colours mean nothing.
 */
static inline void pack_vertex_colors(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                      uint lanes, struct vec4_16 *v)
{
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		const uint from = lanes >> lane & 1 ? lane : popcount((lanes & -lanes) - 1);
		__global const struct geometry *g = &t->geometries[list->instance[from]];

		for (uint k = 0; k < 3; k++)
			v4_put_lane(tables_color(t, g, LANE(p->number[k], uint, lane)), lane, &v[k]);
	}
}

/* point_current_color for all lanes. Under flat shading, the last vertex gives the colour. */
static inline struct vec4_16 pack_current_color(const struct tables *t, const struct pack_list *list,
                                                const struct pack *p, uint lanes)
{
	struct vec4_16 v[3];

	pack_vertex_colors(t, list, p, lanes, v);
	return p->material->shade_model == GL_FLAT ? v[2] : v4_between(v[0], v[1], v[2], p->weight);
}

/* point_matte_color for all lanes. */
static inline struct vec4_16 pack_matte_color(const struct tables *t, const struct pack_list *list,
                                              const struct pack *p, uint lanes)
{
	const struct vec4_16 color = pack_current_color(t, list, p, lanes);

	return p->material->surface.light_unit == SCENE_LIGHT_IN_COLORS ? v4_16(1, 1, 1, color.w) : color;
}

/* --- Points ------------------------------------------------------------------------------------------------------ */

/*
 * The share of the light in a slot that reaches each lane, as in stage_seen: 1 if no rays were sent to it, and in
 * lanes outside the set.
 */
static inline struct vec3_16 pack_seen(const struct shade_arguments *a, const struct pack_list *list, uint lanes,
                                       uint slot)
{
	struct vec3_16 share = v3_16(1, 1, 1);

	if (slot >= a->n_slots)
		return share;
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		__global const float *seen = a->visibility + (slot * a->n + list->item[lane]) * 3u;

		LANE(share.x, float, lane) = seen[0];
		LANE(share.y, float, lane) = seen[1];
		LANE(share.z, float, lane) = seen[2];
	}
	return share;
}

/*
 * point_lit_here for all lanes, on surfaces that rules relight (scene_surface.relit).
 * @param a  its tables are used; if n_slots is not 0, also the visibility of the lights
 */
static inline void pack_lit_here(const struct shade_arguments *a, const struct pack_list *list, const struct pack *p,
                                 const struct pack_surface *s, uint lanes, struct lit_16 *out)
{
	const struct tables *t = &a->tables;
	__global const struct scene_material *m = p->material;
	const packi side = pack_side(p);
	struct vec4_16 color = v4_16(0, 0, 0, 0);
	struct matter_16 matter;
	struct vec3_16 n;

	if (m->lighting) {
		if (m->color_material && m->color_material_mode)
			color = pack_current_color(t, list, p, lanes);
		light_material(m, &m->front, &m->back, side, color, &matter, out);
		n = pack_vertex_normals(t, p);
		n = v3_choose(side, v3_scale(n, (packf)(-1)), n);
	} else {
		light_matte(pack_matte_color(t, list, p, lanes), &matter, out);
		n = pack_normal(t, p, s);
	}
	light_begin(m, pack_place_at(s, p->weight), n, &matter, out);
	for (uint i = 0; i < m->surface.light_count; i++) {
		const struct vec3_16 share = pack_seen(a, list, lanes, i);

		light_add(m, &matter, &t->lights[m->surface.light_first + i], i, i < a->n_slots ? &share : 0, out);
	}
	light_end(m, &matter, out);
}
