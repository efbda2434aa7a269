/*
 * One work item of each kernel that sends rays from fragments and hits to lights, or from fragments into their surroundings, and of
 * those that sum up the rays' visibility. Rays stand slot by slot of a material's lights, in the order of fragments
 * (kernels/gl/stages.h) or hits. A stopped ray goes on in a list of its own, past each surface that lets light pass.
 */
#pragma once

#include "kernels/frame/sample.h"
#include "kernels/frame/transparency.h"

static inline void stage_no_ray(GLOBAL struct ray *ray)
{
	v3_store(ray->o, v3(0.0f, 0.0f, 0.0f));
	v3_store(ray->d, v3(0.0f, 0.0f, 1.0f));
	ray->t_min = 1.0f;
	ray->t_max = 0.0f;
}

/* A ray without end from a point; `from`: the direction of the ray that led there. */
static inline void stage_ray(const struct point *p, struct vec3 direction, struct vec3 from, GLOBAL struct ray *ray)
{
	struct point_plane plane = point_plane_of(p);

	v3_store(ray->o, point_ray_origin(p, &plane, direction, from));
	v3_store(ray->d, direction);
	ray->t_min = 0.0f;
	ray->t_max = 1.0e30f;
}

/* The direction in which a view looks through a pixel: from its near to its far point. */
static inline struct vec3 stage_view_direction(GLOBAL const struct view *view, uint32_t x, uint32_t y)
{
	float nx = 2.0f * ((float)x + 0.5f - view->viewport[0]) / view->viewport[2] - 1.0f;
	float ny = 2.0f * ((float)y + 0.5f - view->viewport[1]) / view->viewport[3] - 1.0f;
	struct vec4 near = m4_mul(view->inverse, v4(nx, ny, -1.0f, 1.0f));
	struct vec4 far = m4_mul(view->inverse, v4(nx, ny, 1.0f, 1.0f));

	return v3(far.x * near.w - near.x * far.w, far.y * near.w - near.y * far.w, far.z * near.w - near.z * far.w);
}

/* --- Lights ------------------------------------------------------------------------------------------------------ */

/*
 * The ray from a point to a light: as far as the light, d not normalised, so that t = 1 is the light itself. `from`: the
 * direction of the ray that led to the point. u, v: which place on the light, where it has a size: a sphere is seen as a
 * disk; the radius of a light at infinity is the tangent of half the angle that it fills.
 */
static inline void stage_light_ray(const struct tables *t, const struct point *p, const struct point_plane *plane, uint32_t slot,
                                   struct vec3 from, float u, float v, GLOBAL struct ray *ray)
{
	GLOBAL const struct scene_light *light = &t->lights[point_lights(p).first + slot];
	struct vec3 to = v3_load(light->position_eye), at = point_place(plane, p->weight), place, o;
	int positional = light->position_eye[3] != 0.0f;

	place = positional ? v3_scale(to, 1.0f / light->position_eye[3]) : to;
	if (light->radius > 0.0f && positional)
		place = v3_add(place, v3_scale(sample_disk(v3_normalize(v3_sub(at, place)), u, v), light->radius));
	else if (light->radius > 0.0f)
		place = v3_add(v3_normalize(to), v3_scale(sample_disk(v3_normalize(to), u, v), light->radius));
	o = point_ray_origin(p, plane, positional ? v3_sub(place, at) : place, from);
	v3_store(ray->o, o);
	v3_store(ray->d, positional ? v3_sub(place, o) : place);
	ray->t_min = 0.0f;
	ray->t_max = positional ? 1.0f : 1.0e30f;
}

/* A triangle as rays from all its fragments need it, kept from the first one. */
struct shadow_kept {
	uint32_t instance, primitive; /* the fragments'; SCENE_NONE: nothing is kept */
	struct point p;               /* without its weights */
	float w_inv[3];
	struct point_plane plane;
};

/*
 * shadow_ray: rays[slot * n + i] goes from fragment i to the light in a slot; an empty ray where none is wanted.
 * sample: which of the rays to each light, over all passes of the frame. keeps, kept: as for shade_item.
 */
static inline void shadow_ray_item(const struct shadow_ray_arguments *a, uint32_t item, int keeps, struct shadow_kept *kept)
{
	const struct tables *t = &a->tables;
	uint32_t slot = item / a->n, i = item % a->n;
	struct fragment f = a->fragments[i];
	struct point p;
	float u, v;

	if (!(a->shaded[i].flags & SHADED_THERE) || !(a->shaded[i].flags & SHADED_WANTS(slot))) {
		stage_no_ray(&a->rays[item]);
		return;
	}
	if (!keeps || kept->instance != f.instance || kept->primitive != f.primitive) {
		kept->instance = f.instance;
		kept->primitive = f.primitive;
		kept->p = point_of_triangle(t, a->windows, &f, kept->w_inv);
		kept->plane = point_plane_of(&kept->p);
	}
	p = kept->p;
	fragment_weights(f, kept->w_inv[0], kept->w_inv[1], kept->w_inv[2], p.weight);
	sample_square(sample_hash(a->pixels[i]) + SAMPLE_LIGHT + slot, a->sample, &u, &v);
	stage_light_ray(t, &p, &kept->plane, slot,
	                stage_view_direction(&a->views[p.geometry->view], a->pixels[i] % a->width, a->pixels[i] / a->width), u, v,
	                &a->rays[item]);
}

/* A seed for a path at its present place. */
static inline uint32_t stage_seed(GLOBAL const struct path *path, GLOBAL const uint32_t *pixels, uint32_t purpose)
{
	return sample_hash(sample_hash(pixels[path->target]) + path->depth * 4u + path->kind) + purpose;
}

/* hit_ray: from hits to lights, as shadow_ray does from fragments. `rays`: those that led to the hits. */
static inline void hit_ray_item(const struct hit_ray_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	uint32_t slot = item / a->n, i = item % a->n;
	struct hit hit = a->hits[i];
	struct point_plane plane;
	struct point p;
	float u, v;

	if (!(a->wanted[i] & SHADED_WANTS(slot))) {
		stage_no_ray(&a->out[item]);
		return;
	}
	p = point_from_hit(t, &hit, v3_load(a->rays[i].d));
	sample_square(stage_seed(&a->paths[i], a->pixels, SAMPLE_LIGHT + slot), a->sample, &u, &v);
	plane = point_plane_of(&p);
	stage_light_ray(t, &p, &plane, slot, v3_load(a->rays[i].d), u, v, &a->out[item]);
}

/* ao_ray: an even look around from each fragment, as far as `reach`. */
static inline void ao_ray_item(const struct ao_ray_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct fragment f = a->fragments[item];
	struct vec3 from, plane, d;
	struct point p;
	float u, v;

	stage_no_ray(&a->rays[item]);
	p = point_from_fragment(t, a->windows, &f);
	if (!(a->shaded[item].flags & SHADED_THERE) || p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	from = stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width, a->pixels[item] / a->width);
	plane = point_plane_normal(&p);
	plane = v3_dot(plane, from) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	sample_square(sample_hash(a->pixels[item]) + SAMPLE_BOUNCE, a->sample, &u, &v);
	d = sample_cosine(point_normal(&p), u, v);
	if (v3_dot(d, plane) <= 0.0f)
		return; /* below the horizon of a faceted surface: neither open nor closed */
	stage_ray(&p, d, from, &a->rays[item]);
	a->rays[item].t_max = a->reach;
}

/* --- Results --------------------------------------------------------------------------------------------------- */

/*
 * shadow_sum: visibility of lights: rays that nothing stopped add `weight`. first: of this list.
 */
static inline void shadow_sum_item(const struct shadow_sum_arguments *a, uint32_t item)
{
	float share = a->occluded[item] ? 0.0f : a->weight;

	for (uint32_t c = 0u; c < 3u; c++)
		a->visibility[item * 3u + c] = a->first ? share : a->visibility[item * 3u + c] + share;
}

/* shadow_start: rays that something stopped, gathered, to go on through what lets light pass. */
static inline void shadow_start_item(const struct shadow_start_arguments *a, uint32_t item)
{
	GLOBAL struct path *w;

	if (!a->occluded[item])
		return;
	w = &a->shadow_paths[a->places[item]];
	a->shadow_rays[a->places[item]] = a->rays[item];
	v3_store(w->weight, v3(a->weight, a->weight, a->weight));
	w->target = item;
	w->kind = w->depth = 0u;
	w->medium = SCENE_NONE;
}

/* shadow_walk: past the surface that a ray to a light hit, or to its end. */
static inline void shadow_walk_item(const struct shadow_walk_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct hit hit = a->hits[item];
	struct path w = a->paths[item];
	struct vec3 weight = v3(w.weight[0], w.weight[1], w.weight[2]);
	GLOBAL float *out = a->visibility + w.target * 3u;

	a->counts[item] = 0u;
	if (hit.instance == SCENE_NONE) {
		v3_store(out, v3_add(v3_load(out), weight));
		return;
	}
	weight = v3_mul(weight, transparency_of_hit(t, &hit, &a->rays[item]));
	if (!(v3_most(weight) > 0.0f))
		return;
	a->next_rays[item] = a->rays[item];
	a->next_rays[item].t_min = ray_beyond(hit.t);
	a->next_paths[item] = w;
	v3_store(a->next_paths[item].weight, weight);
	a->counts[item] = 1u;
}

/* ao_shade: how open a fragment's surroundings are, as its colour or over it. */
static inline void ao_shade_item(const struct ao_shade_arguments *a, uint32_t item)
{
	GLOBAL struct shaded *s = &a->shaded[item];
	float open = a->visibility[item * 3u];
	struct vec3 color = v3(open, open, open);

	if (!(s->flags & SHADED_THERE))
		return;
	if (a->over_gl) {
		color = v3_scale(v3_load(s->gl), open);
		v3_store(s->shadowed, color);
	}
	stage_store_direct(s, color);
}
