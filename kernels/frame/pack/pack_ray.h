/*
 * Rays from sixteen fragments, and to lights: what point.h and shadow.h do for one, in the same order of operations.
 * OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack/pack_surface.h"
#include "kernels/frame/light/shadow.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/frame/light/sample_lanes.h"
#include "kernels/one_lanes.h"

/* point_ray_origin for all lanes. back: opposite to the rays that led to the fragments, of length 1 */
WIDE_VECTORS static inline struct vec3_16 pack_ray_origin(const packf *of_point, const struct pack_surface *s,
                                                          struct vec3_16 towards, struct vec3_16 back)
{
	const struct vec3_16 n = v3_choose(v3_dot(s->plane, towards) < 0.0f, v3_scale(s->plane, (packf)(-1)), s->plane);
	struct vec3_16 at = pack_place_at(s, of_point);
	const packf size = pack_max(v3_extent(at) * POINT_SNAPPING, s->rounding);
	packf weight[3], sum = 0.0f;

	for (int i = 0; i < 3; i++) {
		const packf length = s->length[i];

		weight[i] = pack_max(of_point[i], select((packf)(1.0f / 3.0f), size * length / s->area,
		                                         size * length * 3.0f < s->area));
		sum += weight[i];
	}
	for (int i = 0; i < 3; i++)
		weight[i] /= sum;
	at = pack_place_at(s, weight);
	at = v3_choose(v3_dot(n, back) > 0.0f, v3_add(at, v3_scale(back, size)), at);
	return v3_add(at, v3_scale(n, size));
}

/* Sixteen of struct shadow_curve. */
struct pack_curve {
	packi smooth;
	struct vec3_16 normal[3];
};

WIDE_VECTORS static inline packi pack_is_other(struct vec3_16 a, struct vec3_16 b)
{
	return (a.x != b.x) | (a.y != b.y) | (a.z != b.z);
}

WIDE_VECTORS static inline void pack_curve_of(const struct tables *t, const struct pack *p,
                                              const struct pack_surface *s, struct pack_curve *c)
{
	const packf side = select((packf)(1), (packf)(-1), pack_side(p));
	packf cosine[3];

	c->smooth = 0;
	if (!shadow_may_curve(p->material))
		return;
	for (int k = 0; k < 3; k++) {
		packf row[4];

		pack_vertex(t, p, k, (packu)(PACK_NORMAL), row);
		c->normal[k] = v3_scale(v3_normalize(v3_16(row[0], row[1], row[2])), side);
		cosine[k] = v3_dot(s->plane, c->normal[k]);
	}
	c->smooth = (pack_is_other(c->normal[0], c->normal[1]) | pack_is_other(c->normal[0], c->normal[2])) &
	            ~((pack_max(pack_max(cosine[0], cosine[1]), cosine[2]) > SHADOW_BOTH_SIDES) &
	              (pack_min(pack_min(cosine[0], cosine[1]), cosine[2]) < -SHADOW_BOTH_SIDES));
}

/* shadow_lit_weights for all lanes. @return all ones where a corner faces the light */
WIDE_VECTORS static inline packi pack_lit_weights(const packf *of_point, const packf *cosine, packf *weight)
{
	const packi one = cosine[1] > cosine[0];
	const packi two = select(cosine[2] > cosine[0], cosine[2] > cosine[1], one);
	const packf best = select(select(cosine[0], cosine[1], one), cosine[2], two);
	const packf here = of_point[0] * cosine[0] + of_point[1] * cosine[1] + of_point[2] * cosine[2];
	const packf move = select((packf)(0), -here / (best - here), here < 0.0f);
	const packf moved[3] = { select((packf)(0), move, ~(one | two)), select((packf)(0), move, one & ~two),
		                 select((packf)(0), move, two) };

	for (int i = 0; i < 3; i++)
		weight[i] = of_point[i] * (1.0f - move) + moved[i];
	return best > 0.0f;
}

/* shadow_curve_origin for smooth lanes; the other rays start on their triangles. straight: the direction for
 * point_ray_origin */
WIDE_VECTORS static inline struct vec3_16 pack_curve_origin(const struct pack_curve *c, const struct pack_surface *s,
                                                            const packf *of_point, struct vec3_16 to, int positional,
                                                            struct vec3_16 straight, struct vec3_16 back)
{
	struct vec3_16 n = v3_16(0, 0, 0), lift = n, at, curved;
	packf cosine[3], weight[3];
	packi bent;

	if (!any_pack(c->smooth))
		return pack_ray_origin(of_point, s, straight, back);
	for (int i = 0; i < 3; i++)
		cosine[i] = v3_dot(c->normal[i], v3_normalize(positional ? v3_sub(to, s->corner[i]) : to));
	bent = c->smooth & pack_lit_weights(of_point, cosine, weight);
	at = pack_place_at(s, weight);
	for (int i = 0; i < 3; i++) {
		const packf below = pack_max(v3_dot(v3_sub(s->corner[i], at), c->normal[i]), (packf)(0));

		lift = v3_add(lift, v3_scale(c->normal[i], pack_max(weight[i], (packf)(0)) * below));
		n = v3_add(n, v3_scale(c->normal[i], weight[i]));
	}
	curved = v3_add(pack_ray_origin(weight, s, n, back), lift);
	return any_pack(~bent) ? v3_choose(bent, curved, pack_ray_origin(of_point, s, straight, back)) : curved;
}

/* point_lights: start of a material's lights. */
static inline __global const struct scene_light *pack_lights_of(const struct tables *t,
                                                                __global const struct scene_material *m)
{
	return t->lights + (m->surface.relit ? m->surface.light_first : m->light_first);
}

/* stage_light_ray for a light and a material that pack_refuses_rays* do not refuse; writes rays[place[lane]] for the
 * lanes that need a ray. */
static inline void pack_light_rays(const struct pack *p, const struct pack_surface *s, const struct pack_curve *curve,
                                   struct vec3_16 back, __global const struct scene_light *light, uint lanes,
                                   const uint *place, __global struct ray *rays)
{
	const int positional = light->position_eye[3] != 0.0f;
	const float scale = positional ? 1.0f / light->position_eye[3] : 1.0f;
	const struct vec3_16 to = v3_same(v3_scale(v3_load(light->position_eye), scale));
	const struct vec3_16 straight = positional ? v3_sub(to, pack_place_at(s, p->weight)) : to;
	const packi away = (v3_dot(s->plane, straight) < 0.0f) != (v3_dot(s->plane, back) < 0.0f);
	const packi within = p->material->surface.hidden & SCENE_FACETED ? (packi)(0) : ~curve->smooth & away;
	const struct vec3_16 o = pack_curve_origin(curve, s, p->weight, to, positional, straight, back);
	const struct vec3_16 d = positional ? v3_sub(to, o) : to;
	packf from[4], way[4];

	pack_turn_rows(o.x, o.y, o.z, select((packf)(0), (packf)(SHADOW_WITHIN), within), from);
	pack_turn_rows(d.x, d.y, d.z, (packf)(positional ? 1.0f : 1.0e30f), way);
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		__global gather_loose *ray = (__global gather_loose *)(rays + place[lane]);

		if (!(lanes >> lane & 1))
			continue;
		ray[0] = LANE(from[lane % 4], float4, lane / 4);
		ray[1] = LANE(way[lane % 4], float4, lane / 4);
	}
}
