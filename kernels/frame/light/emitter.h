/*
 * Direct light from emissive surfaces, in mode path. Each point sends one ray to one place on one emissive triangle,
 * chosen in proportion to the light it sends, with places uniform in area. Light that a scattered ray finds there also
 * counts. Both are weighted by the power heuristic (E. Veach and L. Guibas, "Optimally Combining Sampling Techniques
 * for Monte Carlo Rendering", 1995, sec. 4).
 *
 * Only matte, lit surfaces without holes are sampled this way (emitter_strength). Light of all other surfaces, and of
 * skies, is found by scattered rays alone, with weight 1.
 */
#pragma once

#include "kernels/frame/light/shadow.h"

/* A material's brightness, which times area gives the probability of sampling a triangle. attributes: those of the
 * geometry. 0: never sampled */
static inline float emitter_strength(uint32_t transport, GLOBAL const struct scene_material *m, uint32_t attributes)
{
	const struct vec3 by_rule = stage_light(transport, v3_load(m->surface.emission));
	float most = v3_most(by_rule);

	if (!(m->lighting || m->surface.relit) || m->blend || m->alpha_test || m->alpha_to_coverage || m->clip_plane_mask ||
	    m->polygon_stipple != SCENE_NONE || !(m->color_mask & 7u) ||
	    m->polygon_mode_front != GL_FILL || m->polygon_mode_back != GL_FILL ||
	    m->surface.reflect > 0.0f || m->surface.transmit > 0.0f || m->surface.hidden & ~(SCENE_FACETED | SCENE_DOME_LIT))
		return 0.0f;
	if (m->lighting && !(attributes & SCENE_HAS_FACE))
		most += M_MAX(v3_most(stage_light(transport, v3_load(m->front.emission))),
		              v3_most(stage_light(transport, v3_load(m->back.emission))));
	return most;
}

/* Light that a point of such a surface sends. */
static inline struct vec3 emitter_sends(const struct tables *t, const struct point *p, uint32_t transport)
{
	const struct vec3 by_rule = stage_light(transport, v3_load(p->material->surface.emission));

	if (!p->material->lighting)
		return by_rule;
	return v3_add(
		by_rule,
		stage_light(transport, v3_load(tables_face(t, p->geometry, p->number[2], point_side(p))->emission)));
}

/* Choose an emitter by u, and the place on it by (the rest of u, v), seen from the end of `from`; returned as a hit. */
static inline struct hit emitter_choose(const struct emission *e, float u, float v)
{
	uint32_t low = e->emitter_first, high = e->emitter_first + e->n_emitters - 1u;
	float begin, root;
	struct hit hit;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2u;

		if (u < e->emitters[middle].end)
			high = middle;
		else
			low = middle + 1u;
	}
	begin = low > e->emitter_first ? e->emitters[low - 1u].end : 0.0f;
	root = M_SQRT(clamp01((u - begin) / (e->emitters[low].end - begin)));
	hit.instance = e->emitters[low].instance;
	hit.primitive = e->emitters[low].primitive;
	hit.b1 = 1.0f - root;
	hit.b2 = v * root;
	hit.t = 0.0f;
	return hit;
}

/* Density of the sampled directions towards a point. distance: to the point; cosine: at the point */
static inline float emitter_density(const struct emission *e, float strength, float distance2, float cosine)
{
	return strength / e->emitted * distance2 / M_MAX(M_ABS(cosine), 1e-6f);
}

/* Power heuristic: weight of the first of two ways to reach the same place, by their densities. */
static inline float emitter_weight(float density, float other)
{
	const float share = other / density;

	return 1.0f / (1.0f + share * share);
}

/* Sample numbers for choosing the place (sample_take). */
struct emitter_sample {
	uint32_t frame, seed, index;
};

/* The ray from a point to the place, which would be at t = 1. from: the direction of the ray that led to the point */
static inline void emitter_ray(const struct tables *t, const struct emission *e, const struct point *p,
                               struct vec3 from, const struct emitter_sample *at, GLOBAL struct ray *ray)
{
	const struct point_plane plane = point_plane_of(p);
	struct vec3 to, o;
	struct hit hit;
	struct point q;
	float u, v;

	sample_take(at->frame, at->seed + SAMPLE_EMITTER, at->index, &u, &v);
	hit = emitter_choose(e, u, v);
	q = point_from_hit(t, &hit, from);
	to = point_position(&q);
	o = point_ray_origin(p->weight, &plane, v3_sub(to, point_position(p)), from);
	v3_store(ray->o, o);
	v3_store(ray->d, v3_sub(to, o));
	ray->t_min = 0.0f;
	ray->t_max = 0.9995f;
}

/* Unoccluded light from the emitter, as reflected by a matte white point. */
static inline struct vec3 emitter_light(const struct tables *t, const struct emission *e, uint32_t transport,
                                        const struct point *p, struct vec3 from, const struct emitter_sample *at)
{
	struct vec3 plane = point_plane_normal(p), to, d;
	float u, v, distance2, cosine, density, scattered;
	struct hit hit;
	struct point q;

	sample_take(at->frame, at->seed + SAMPLE_EMITTER, at->index, &u, &v);
	hit = emitter_choose(e, u, v);
	q = point_from_hit(t, &hit, from);
	to = v3_sub(point_position(&q), point_position(p));
	distance2 = v3_dot(to, to);
	d = v3_normalize(to);
	plane = v3_dot(plane, from) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	cosine = v3_dot(point_normal(p), d);
	if (!(cosine > 0.0f) || !(v3_dot(plane, d) > 0.0f) || !(distance2 > 0.0f))
		return v3(0.0f, 0.0f, 0.0f);
	q = point_from_hit(t, &hit, d); /* the side that is visible from here */
	density = emitter_density(e, emitter_strength(transport, q.material, q.geometry->attributes), distance2,
	                          v3_dot(point_plane_normal(&q), d));
	scattered = cosine * 0.31830988618f;
	return v3_scale(emitter_sends(t, &q, transport), scattered / density * emitter_weight(density, scattered));
}

/* leave_ray: for the fragments of the list. */
static inline void leave_ray_item(const struct leave_ray_arguments *a, uint32_t item)
{
	const struct emitter_sample at = { a->frame, sample_hash(a->pixels[item]), a->sample };
	struct fragment f = a->fragments[item];
	struct point p;

	stage_no_ray(&a->rays[item]);
	if (!(a->shaded[item].flags & SHADED_THERE))
		return;
	p = point_from_fragment(&a->tables, a->windows, &f);
	if (point_takes_light(&p))
		emitter_ray(&a->tables, &a->emission, &p,
		            stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width,
		                                 a->pixels[item] / a->width),
		            &at, &a->rays[item]);
}

/* bounce_ray: for hits of paths that may continue. */
static inline void bounce_ray_item(const struct bounce_ray_arguments *a, uint32_t item)
{
	const struct emitter_sample at = { a->frame, stage_seed(&a->paths[item], a->pixels, 0u), a->sample };
	GLOBAL struct ray *ray = &a->out[a->first + item];
	struct hit hit = a->hits[item];
	struct point p;

	stage_no_ray(ray);
	if (hit.instance == SCENE_NONE || a->paths[item].depth >= a->depth)
		return;
	p = point_from_hit(&a->tables, &hit, v3_load(a->rays[item].d));
	if (point_takes_light(&p))
		emitter_ray(&a->tables, &a->emission, &p, v3_load(a->rays[item].d), &at, ray);
}
