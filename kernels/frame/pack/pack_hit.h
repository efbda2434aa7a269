/*
 * Hits of paths, and fragments that light leaves, sixteen of one material at once: what point.h, transparency.h and
 * path.h do for one, in the same order of operations and with bit-identical results. OpenCL C only. pack_knows_paths
 * tests which materials are supported.
 */
#pragma once

#include "kernels/frame/pack/pack_ray.h"
#include "kernels/frame/pack/pack_shade.h"
#include "kernels/frame/light/path.h"

/* Points on triangles, and the directions they are seen along. */
struct pack_points {
	struct pack_list list;
	uint lanes;
	struct pack p;
	struct pack_surface surface;
	struct vec3_16 d, back;  /* d: of the rays; back: opposite, of length 1 */
	packf t, t_min;          /* for hits */
};

/* Test whether packs support everything that a material needs for fragments that light leaves. */
static inline int pack_knows_leaving(const struct shade_arguments *s, __global const struct scene_material *m)
{
	return s->transport == TRANSPORT_GL && pack_is_plain(s, m) && !pack_refuses_rays(m);
}

/* The same for hits. A near mirror seen in another mirror reflects nothing. */
static inline int pack_knows_paths(const struct shade_arguments *s, __global const struct scene_material *m)
{
	return pack_knows_leaving(s, m) && !pack_refuses_hits(m);
}

/* The same for light transport: matte surfaces that may emit only their own colour. */
static inline int pack_knows_bounces(const struct shade_arguments *s, __global const struct scene_material *m)
{
	return pack_is_plain(s, m) && !pack_refuses_rays(m) && !pack_refuses_bounces(m);
}

/* --- Where they are ---------------------------------------------------------------------------------------------- */

static inline void pack_take_hit(__global const struct hit *hits, uint item, uint lane, struct pack_list *list)
{
	list->item[lane] = item;
	list->instance[lane] = hits[item].instance;
	list->primitive[lane] = hits[item].primitive;
	list->b1[lane] = hits[item].b1;
	list->b2[lane] = hits[item].b2;
	list->depth[lane] = hits[item].t;
	list->pixel[lane] = 0;
}

/* point_divide_weights for the lanes `which`. */
WIDE_VECTORS static inline void pack_divide_weights(packf (*e)[4], packi which, packf *weight)
{
	packf divided[3], sum;

	for (int k = 0; k < 3; k++)
		divided[k] = weight[k] / e[k][3];
	sum = divided[0] + divided[1] + divided[2];
	for (int k = 0; k < 3; k++)
		weight[k] = select(weight[k], divided[k] / sum, which);
}

/* Place the hits of q->list, as in point_from_hit. material: theirs */
WIDE_VECTORS static inline void pack_place_hits(const struct tables *t, __global const struct ray *rays,
                                                __global const struct scene_material *material, struct pack_points *q)
{
	const packu ray = vload16(0, q->list.item) * 8;
	struct pack *p = &q->p;
	packf o[4], d[4], e[3][4];
	packi behind, bent;

	p->material = material;
	pack_load(t, 1, 1, &q->list, q->lanes, p);
	pack_gather_from((__global const float *)rays, ray, o);
	pack_gather_from((__global const float *)rays, ray + 4, d);
	q->d = v3_16(d[0], d[1], d[2]);
	q->back = v3_scale(v3_normalize(q->d), (packf)(-1));
	q->t = p->depth;
	q->t_min = o[3];
	p->weight[0] = 1.0f - p->b1 - p->b2;
	p->weight[1] = p->b1;
	p->weight[2] = p->b2;
	bent = pack_eyes(t, p, e);
	if (any_pack(bent))
		pack_divide_weights(e, bent, p->weight);
	pack_surface_through(p, e, bent, &q->surface);
	pack_measure(p, &q->surface);
	behind = v3_dot(q->surface.plane, q->d) > 0.0f;
	p->front = material->front_face == GL_CW ? behind : ~behind;
}

/* Sample textures at hits, as point_texture does for points without neighbours. */
WIDE_VECTORS static inline void pack_texture_hits(const struct tables *t, const struct pack_list *list,
                                                  const struct pack *p, uint lanes, struct pack_texturing *out)
{
	__global const struct scene_material *m = p->material;
	const packu first = pack_texcoord_first(t, list, m, lanes, p->uniform);

	for (uint i = 0; i < m->unit_count; i++) {
		__global const struct scene_unit *unit = &t->units[m->unit_first + i];
		__global const struct texture_image *image = &t->textures[unit->texture];
		packf c[4] = { 0.0f, 0.0f, 0.0f, 0.0f }, over;
		packu texel;

		for (int k = 0; k < 3; k++) {
			packf texcoord[4];

			pack_row(t->texcoords, p, first + p->number[k] * m->unit_count + i, texcoord);
			for (int j = 0; j < 4; j++)
				c[j] += texcoord[j] * p->weight[k];
		}
		over = 1.0f / c[3];
		for (int j = 0; j < 3; j++)
			c[j] *= over;
		if (unit->mag_filter == GL_NEAREST) {
			texel = pack_nearest(t, unit, c);
		} else {
			const struct pack_level l = pack_level(image, 0);

			texel = pack_level_8(t, unit, &l, c);
		}
		for (int j = 0; j < 4; j++)
			c[j] = convert_float16(texel >> (packu)(8 * j) & 255) * (1.0f / 255.0f);
		out->sample[unit->unit] = v4_16(c[0], c[1], c[2], c[3]);
	}
	out->fog = pack_fog(t, p);
}

/* --- Ways on ----------------------------------------------------------------------------------------------------- */

/* Sixteen of struct split. */
struct pack_split {
	struct vec3_16 normal;
	packf mirrored, through, base, eta, cosine, cosine_beyond;
};

/* glass_fresnel for all lanes. */
WIDE_VECTORS static inline packf pack_fresnel(packf eta, packf cosine, packf *cosine_beyond)
{
	const packf k = 1.0f - eta * eta * (1.0f - cosine * cosine);
	const packi passes = k > 0.0f;
	const packf beyond = sqrt(select((packf)(0), k, passes));
	const packf across = (eta * cosine - beyond) / (eta * cosine + beyond),
		    along = (cosine - eta * beyond) / (cosine + eta * beyond);

	*cosine_beyond = beyond;
	return select((packf)(1), 0.5f * (across * across + along * along), passes);
}

/* glass_enters for all lanes. */
WIDE_VECTORS static inline packi pack_enters(const struct pack *p)
{
	const uint hidden = p->material->surface.hidden;

	return hidden & SCENE_ENTERED ? (packi)(-1) : hidden & SCENE_BACK_OUTSIDE ? ~p->front : p->front;
}

/* split_light for all lanes. d: of the length that split_light expects */
WIDE_VECTORS static inline void pack_split_light(const struct tables *t, const struct pack_points *q, struct vec3_16 d,
                                                 struct pack_split *s)
{
	__global const struct scene_material *m = q->p.material;
	const float mirrored = clamp01(m->surface.reflect), through = fmin(clamp01(m->surface.transmit), 1.0f - mirrored);
	packf fresnel = 0.0f;

	s->normal = pack_normal(t, &q->p, &q->surface);
	s->base = 1.0f - mirrored - through;
	s->eta = select((packf)(glass_ior(m)), (packf)(1.0f / glass_ior(m)), pack_enters(&q->p));
	s->cosine = clamp01(-v3_dot(s->normal, d));
	s->cosine_beyond = 0.0f;
	if (through > 0.0f)
		fresnel = pack_fresnel(s->eta, s->cosine, &s->cosine_beyond);
	s->mirrored = mirrored + through * fresnel;
	s->through = through * (1.0f - fresnel);
}

/* Destination of the next rays of items, with `slots` places per item. */
struct pack_branches {
	__global struct ray *rays;
	__global struct path *paths;
	uint slots;
	uint count[PACK_SIZE];      /* rays of each lane so far */
	packu target, depth, medium; /* from the paths that end here */
};

/* branch_on_side for all lanes. */
WIDE_VECTORS static inline struct vec3_16 pack_on_side(struct vec3_16 d, struct vec3_16 plane)
{
	const packf into = v3_dot(d, plane);

	return v3_choose(into < 0.0f, v3_normalize(v3_sub(d, v3_scale(plane, 1.001f * into))), d);
}

/* Rays of some lanes in a direction, as in branch and stage_ray. */
WIDE_VECTORS static inline void pack_branch(const struct pack_points *q, uint lanes, struct vec3_16 direction,
                                            struct vec3_16 weight, packu kind, packu medium, struct pack_branches *b)
{
	const struct vec3_16 o = pack_ray_origin(q->p.weight, &q->surface, direction, q->back);
	const packf most = v3_most(weight);
	const packu depth = b->depth + 1;

	for (uint left = lanes & pack_bits(most > PATH_LEAST); left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1), at = q->list.item[lane] * b->slots + b->count[lane]++;
		__global struct path *path = &b->paths[at];

		vstore8((float8)(LANE(o.x, const float, lane), LANE(o.y, const float, lane),
		                 LANE(o.z, const float, lane), 0, LANE(direction.x, float, lane),
		                 LANE(direction.y, float, lane), LANE(direction.z, float, lane), 1.0e30f),
		        at, (__global float *)b->rays);
		path->weight[0] = LANE(weight.x, float, lane);
		path->weight[1] = LANE(weight.y, float, lane);
		path->weight[2] = LANE(weight.z, float, lane);
		path->target = LANE(b->target, uint, lane);
		path->kind = LANE(kind, uint, lane);
		path->depth = LANE(depth, const uint, lane);
		path->medium = LANE(medium, uint, lane);
		path->density = 0.0f;
	}
}

/* branch_normal for all lanes. */
WIDE_VECTORS static inline struct vec3_16 pack_mirror_normal(const struct tables *t, const struct pack *p,
                                                             struct vec3_16 n)
{
	const uint kind = p->material->surface.hidden & (SCENE_NEAR_MIRROR | SCENE_NO_NORMALS);

	return p->material->lighting || kind != SCENE_NEAR_MIRROR ? n : pack_smooth_normal(t, p, n);
}

/* branch_mirror for smooth materials. */
WIDE_VECTORS static inline void pack_branch_mirror(const struct tables *t, const struct pack_points *q, uint lanes,
                                                   struct vec3_16 d, const struct pack_split *s, struct vec3_16 weight,
                                                   packu kind, struct pack_branches *b)
{
	const struct vec3_16 n = pack_mirror_normal(t, &q->p, s->normal), plane = q->surface.plane;
	const struct vec3_16 away = v3_sub(d, v3_scale(n, 2.0f * v3_dot(d, n)));
	const struct vec3_16 side = v3_choose(v3_dot(plane, d) > 0.0f, v3_scale(plane, (packf)(-1)), plane);

	pack_branch(q, lanes, pack_on_side(away, side), weight, kind, b->medium, b);
}

/* branch_mirror for fragments of rough materials. */
static inline void pack_branch_rough(const struct leave_arguments *a, const struct pack_points *q, struct vec3_16 d,
                                     const struct pack_split *s, struct vec3_16 weight, packu kind,
                                     struct pack_branches *b)
{
	const struct vec3_16 n = pack_mirror_normal(&a->tables, &q->p, s->normal), plane = q->surface.plane;
	const struct vec3_16 side = v3_choose(v3_dot(plane, d) > 0.0f, v3_scale(plane, (packf)(-1)), plane);
	struct vec3_16 away = v3_sub(d, v3_scale(n, 2.0f * v3_dot(d, n))), across, along, off;
	packf right = 0, up = 0;

	for (uint left = q->lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		float u, v, radius, turn;

		sample_square(sample_hash(q->list.pixel[lane]) + SAMPLE_GLOSS, a->sample, &u, &v);
		radius = M_SQRT(u);
		turn = 6.283185307179586f * v;
		LANE(right, float, lane) = radius * M_COS(turn);
		LANE(up, float, lane) = radius * M_SIN(turn);
	}
	sample_basis(away, &across, &along);
	off = v3_add(v3_scale(across, right), v3_scale(along, up));
	away = v3_normalize(v3_add(away, v3_scale(off, (packf)(q->p.material->surface.roughness))));
	pack_branch(q, q->lanes, pack_on_side(away, side), weight, kind, b->medium, b);
}

/* branch_through for all lanes. */
WIDE_VECTORS static inline void pack_branch_through(const struct tables *t, const struct pack_points *q, uint lanes,
                                                    struct vec3_16 d, const struct pack_split *s, struct vec3_16 weight,
                                                    packu kind, struct pack_branches *b)
{
	const struct vec3_16 on = v3_normalize(
		v3_add(v3_scale(d, s->eta), v3_scale(s->normal, s->eta * s->cosine - s->cosine_beyond)));
	const struct vec3_16 plane = q->surface.plane;
	const struct vec3_16 side = v3_choose(v3_dot(plane, d) < 0.0f, v3_scale(plane, (packf)(-1)), plane);
	const uint material = (uint)(q->p.material - t->materials);

	pack_branch(q, lanes, pack_on_side(on, side), weight, kind,
	            select((packu)(SCENE_NONE), (packu)(material), pack_enters(&q->p)), b);
}

/* glass_tint for all lanes. from_vertices: colours as lit at the vertices */
static inline struct vec3_16 pack_tint(const struct tables *t, const struct pack_points *q,
                                       const struct pack_texturing *texturing, const struct vec4_16 *from_vertices)
{
	const struct vec4_16 c = pack_albedo(t, &q->list, &q->p, q->lanes, texturing, from_vertices);

	return v3_16(sqrt(clamp01(c.x)), sqrt(clamp01(c.y)), sqrt(clamp01(c.z)));
}

/* --- Ways that chance chooses ------------------------------------------------------------------------------------ */

/* sample_cosine for all lanes. */
static inline struct vec3_16 pack_cosine(struct vec3_16 n, packf u, packf v, uint lanes)
{
	const packf radius = sqrt(u), turn = 6.283185307179586f * v;
	packf right = 0, up = 0;
	struct vec3_16 across, along;

	for (uint left = lanes; left; left &= left - 1) { /* one by one, since vector cosines differ in their last bits */
		const uint lane = popcount((left & -left) - 1);

		LANE(right, float, lane) = LANE(radius, const float, lane) * M_COS(LANE(turn, const float, lane));
		LANE(up, float, lane) = LANE(radius, const float, lane) * M_SIN(LANE(turn, const float, lane));
	}
	sample_basis(n, &across, &along);
	return v3_normalize(v3_add(v3_add(v3_scale(across, right), v3_scale(along, up)), v3_scale(n, sqrt(1.0f - u))));
}

/*
 * branch_one for matte surfaces. Paths get no density: only emissive surfaces need it, and packs do not support those.
 * seed: of the paths. albedo: as light
 */
static inline void pack_branch_scatter(const struct shade_hit_arguments *a, const struct pack_points *q, uint lanes,
                                       packu seed, struct vec3_16 albedo, struct vec3_16 weight, packu kind,
                                       struct pack_branches *b)
{
	const uint frame = sample_hash(a->frame);
	const struct vec3_16 n = pack_normal(&a->tables, &q->p, &q->surface), plane = q->surface.plane;
	const struct vec3_16 side = v3_choose(v3_dot(plane, q->d) > 0.0f, v3_scale(plane, (packf)(-1)), plane);
	struct vec3_16 on;
	packf u, v, share;
	packi goes_on;

	sample_sobol((seed + SAMPLE_CHOICE) ^ frame, a->sample, &u, &v);
	weight = v3_mul(weight, albedo);
	share = v3_most(weight) / PATH_ROULETTE;
	goes_on = ~(share < 1.0f);
	weight = v3_choose(goes_on, weight, v3_scale(weight, 1.0f / share));
	lanes &= pack_bits(goes_on | (v < share));
	if (!lanes)
		return;
	sample_sobol((seed + SAMPLE_BOUNCE) ^ frame, a->sample, &u, &v);
	on = pack_cosine(n, u, v, lanes);
	pack_branch(q, lanes, pack_on_side(on, side), weight, kind, b->medium, b);
}
