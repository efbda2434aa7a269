/*
 * One work item of each kernel that sends rays from fragments and hits to lights, or from fragments to their
 * surroundings, and of the kernels that sum the rays' visibility. Rays are ordered by slot of a material's lights, then
 * by fragment (kernels/gl/stages.h) or hit. A stopped ray continues in a separate list, through each surface that lets
 * light pass.
 */
#pragma once

#include "kernels/frame/light/sample.h"
#include "kernels/frame/light/transparency.h"
#include "kernels/rays/rays.h"

/* t_min of a ray to a light that starts inside the body that it lights: a negative zero as a marker (shadow_walk). */
#define SHADOW_WITHIN (-0.0f)

static inline int shadow_begins_within(GLOBAL const struct ray *ray)
{
	return M_BITS(ray->t_min) == 0x80000000u;
}

static inline void stage_no_ray(GLOBAL struct ray *ray)
{
	v3_store(ray->o, v3(0.0f, 0.0f, 0.0f));
	v3_store(ray->d, v3(0.0f, 0.0f, 1.0f));
	ray->t_min = 1.0f;
	ray->t_max = 0.0f;
}

/* An unbounded ray from a point; `from`: the direction of the ray that led to the point. */
static inline void stage_ray(const struct point *p, struct vec3 direction, struct vec3 from, GLOBAL struct ray *ray)
{
	struct point_plane plane = point_plane_of(p);

	v3_store(ray->o, point_ray_origin(p->weight, &plane, direction, from));
	v3_store(ray->d, direction);
	ray->t_min = 0.0f;
	ray->t_max = 1.0e30f;
}

/* The viewing direction through a pixel: from its near to its far point. */
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
 * The surface implied by a triangle's three normals. `smooth` is 0 if they are equal, if only one is used, or if they
 * are on both sides of the triangle, as on a thin fin. Rays then start on the triangle itself, on the light's side: a
 * surface above the triangle on one side would be below it on the other, and the triangle would block its own light.
 */
struct shadow_curve {
	int smooth;
	struct vec3 normal[3]; /* at the corners, on the lit side */
};

static inline int shadow_is_other(struct vec3 a, struct vec3 b)
{
	return (a.x != b.x) | (a.y != b.y) | (a.z != b.z);
}

/* Normals count as on both sides of a triangle from 6 degrees on, given as a cosine to the triangle's own normal. */
#define SHADOW_BOTH_SIDES 0.1f

/* Test whether normals may curve a material's triangles. */
static inline int shadow_may_curve(GLOBAL const struct scene_material *m)
{
	return (m->lighting || m->program_normals) &&
	       (m->shade_model != GL_FLAT || m->surface.hidden & SCENE_CREASED) && !(m->surface.hidden & SCENE_FACETED);
}

static inline struct shadow_curve shadow_curve_of(const struct tables *t, const struct point *p,
                                                  const struct point_plane *plane)
{
	struct shadow_curve c;
	const float side = point_side(p) ? -1.0f : 1.0f;
	float cosine[3];

	for (uint32_t i = 0u; i < 3u; i++) {
		c.normal[i] = v3_scale(v3_normalize(point_corner_normal(t, p, i)), side); /* GL may not have normalised it */
		cosine[i] = v3_dot(plane->normal, c.normal[i]);
	}
	c.smooth = shadow_may_curve(p->material) &&
	           (shadow_is_other(c.normal[0], c.normal[1]) || shadow_is_other(c.normal[0], c.normal[2])) &&
	           !(M_MAX(M_MAX(cosine[0], cosine[1]), cosine[2]) > SHADOW_BOTH_SIDES &&
	             M_MIN(M_MIN(cosine[0], cosine[1]), cosine[2]) < -SHADOW_BOTH_SIDES);
	return c;
}

/*
 * Weights of the place where the light's visibility is tested. A vertex that faces the light partly lights all of its
 * triangles (sec. 2.14.1, Gouraud 1971), beyond the line where the interpolated normal turns away. From there, the
 * surface itself would block the light. So a point beyond the line is moved to the line, straight towards the corner
 * that faces the light most.
 *
 * cosine: of each corner's normal to the light.
 * @return 0: no corner faces the light
 */
static inline int shadow_lit_weights(const float *of_point, const float *cosine, float *weight)
{
	const int best = cosine[1] > cosine[0] ? (cosine[2] > cosine[1] ? 2 : 1) : (cosine[2] > cosine[0] ? 2 : 0);
	float here = of_point[0] * cosine[0] + of_point[1] * cosine[1] + of_point[2] * cosine[2];
	float move = here < 0.0f ? -here / (cosine[best] - here) : 0.0f;

	if (!(cosine[best] > 0.0f))
		return 0;
	for (int i = 0; i < 3; i++)
		weight[i] = of_point[i] * (1.0f - move) + (i == best ? move : 0.0f);
	return 1;
}

/*
 * Start of a ray to a light on a triangle with differing normals: above it, on a surface that has these normals at its
 * corners (J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, ch. 4). Otherwise flat faces would
 * block grazing light, and the shadow border would follow the triangles' edges. Where the corners' normals bend
 * inwards, nothing is moved.
 *
 * The start is continuous from triangle to triangle, and so are shadows cast on them. If pixels have several samples,
 * their centres may be outside the triangle: a negative weight must not lower the start. to: the light, or the
 * direction to it.
 */
static inline struct vec3 shadow_curve_origin(const struct shadow_curve *c, const struct point_plane *plane,
                                              const float *of_point, struct vec3 to, int positional, struct vec3 from)
{
	struct vec3 n = v3(0.0f, 0.0f, 0.0f), lift = n, at;
	float cosine[3], weight[3];

	for (int i = 0; i < 3; i++)
		cosine[i] = v3_dot(c->normal[i], v3_normalize(positional ? v3_sub(to, plane->corner[i]) : to));
	if (!shadow_lit_weights(of_point, cosine, weight))
		return point_ray_origin(of_point, plane, positional ? v3_sub(to, point_place(plane, of_point)) : to, from);
	at = point_place(plane, weight);
	for (int i = 0; i < 3; i++) {
		float below = M_MAX(v3_dot(v3_sub(plane->corner[i], at), c->normal[i]), 0.0f);

		lift = v3_add(lift, v3_scale(c->normal[i], M_MAX(weight[i], 0.0f) * below));
		n = v3_add(n, v3_scale(c->normal[i], weight[i]));
	}
	return v3_add(point_ray_origin(weight, plane, n, from), lift);
}

/*
 * 1 if the visible side of a triangle faces away from a light. GL lights such a triangle only because its normals lean
 * towards the light. Normals of a curved surface show where its own shadow begins (shadow_curve_origin), and rules may
 * treat its faces that way. Other normals describe no surface, and then the body behind the triangle does not block
 * that light (shadow_walk).
 */
static inline int shadow_turns_away(const struct point_plane *plane, struct vec3 towards, struct vec3 from)
{
	return (v3_dot(plane->normal, towards) < 0.0f) == (v3_dot(plane->normal, from) < 0.0f);
}

/*
 * The ray from a point to a light. Its d is not normalised, and t = 1 is the light itself. `from`: the direction of the
 * ray that led to the point. u, v: the place on the light, if it has a size: a sphere is sampled as a disk; the radius
 * of a light at infinity is the tangent of half its angular diameter.
 */
static inline void stage_light_ray(const struct tables *t, const struct point *p, const struct point_plane *plane,
                                   const struct shadow_curve *curve, uint32_t slot, struct vec3 from, float u, float v,
                                   GLOBAL struct ray *ray)
{
	GLOBAL const struct scene_light *light = &t->lights[point_lights(p).first + slot];
	struct vec3 to = v3_load(light->position_eye), at = point_place(plane, p->weight), place, o;
	int positional = light->position_eye[3] != 0.0f, within;

	place = positional ? v3_scale(to, 1.0f / light->position_eye[3]) : to;
	if (light->radius > 0.0f && positional)
		place = v3_add(place, v3_scale(sample_disk(v3_normalize(v3_sub(at, place)), u, v), light->radius));
	else if (light->radius > 0.0f)
		place = v3_add(v3_normalize(to), v3_scale(sample_disk(v3_normalize(to), u, v), light->radius));
	to = positional ? v3_sub(place, at) : place;
	within = !curve->smooth && !(p->material->surface.hidden & SCENE_FACETED) && shadow_turns_away(plane, to, from);
	o = curve->smooth ? shadow_curve_origin(curve, plane, p->weight, place, positional, from) :
	                    point_ray_origin(p->weight, plane, to, from);
	place = positional ? v3_sub(place, o) : place;
	v3_store(ray->o, o);
	v3_store(ray->d, place);
	ray->t_min = within ? SHADOW_WITHIN : 0.0f;
	ray->t_max = positional ? 1.0f : 1.0e30f;
	if (p->material->surface.hidden & SCENE_CARD)
		ray->t_min = M_MIN(M_MAX(M_MAX(plane->length[0], plane->length[1]), plane->length[2]) /
		                           M_SQRT(v3_dot(place, place)),
		                   ray->t_max);
}

/* A triangle as needed by rays from all its fragments, cached from the first one. */
struct shadow_kept {
	uint32_t instance, primitive; /* the fragments'; SCENE_NONE: empty */
	struct point p;               /* without its weights */
	float w_inv[3];
	struct point_plane plane;
	struct shadow_curve curve;
};

/*
 * shadow_ray: rays[slot * n + i] goes from fragment i to the light in a slot; an empty ray if none is needed. sample:
 * index of the ray to each light, over all passes of the frame. keeps, kept: as for shade_item.
 */
static inline void shadow_ray_item(const struct shadow_ray_arguments *a, uint32_t item, int keeps,
                                   struct shadow_kept *kept)
{
	const struct tables *t = &a->tables;
	uint32_t slot = item / a->n, i = item % a->n;
	struct fragment f = a->fragments[i];
	int is_new = 0;
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
		is_new = 1;
	}
	p = kept->p;
	fragment_weights(f, kept->w_inv[0], kept->w_inv[1], kept->w_inv[2], p.weight);
	if (is_new || !point_is_affine(&p)) {
		kept->plane = point_plane_of(&p);
		kept->curve = shadow_curve_of(t, &p, &kept->plane);
	}
	sample_take(a->frame, sample_hash(a->pixels[i]) + SAMPLE_LIGHT + slot, a->sample, &u, &v);
	stage_light_ray(t, &p, &kept->plane, &kept->curve, slot,
	                stage_view_direction(&a->views[p.geometry->view], a->pixels[i] % a->width, a->pixels[i] / a->width),
	                u, v,
	                &a->rays[item]);
}

/* A seed for a path at its current position. */
static inline uint32_t stage_seed(GLOBAL const struct path *path, GLOBAL const uint32_t *pixels, uint32_t purpose)
{
	return sample_hash(sample_hash(pixels[path->target]) + path->depth * 4u + path->kind) + purpose;
}

/* hit_ray: from hits to lights, as shadow_ray does for fragments. `rays`: those that led to the hits. */
static inline void hit_ray_item(const struct hit_ray_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	uint32_t slot = item / a->n, i = item % a->n;
	struct hit hit = a->hits[i];
	struct point_plane plane;
	struct shadow_curve curve;
	struct point p;
	float u, v;

	if (!(a->wanted[i] & SHADED_WANTS(slot))) {
		stage_no_ray(&a->out[item]);
		return;
	}
	p = point_from_hit(t, &hit, v3_load(a->rays[i].d));
	sample_take(a->frame, stage_seed(&a->paths[i], a->pixels, SAMPLE_LIGHT + slot), a->sample, &u, &v);
	plane = point_plane_of(&p);
	curve = shadow_curve_of(t, &p, &plane);
	stage_light_ray(t, &p, &plane, &curve, slot, v3_load(a->rays[i].d), u, v, &a->out[item]);
}

/* ao_ray: rays around each fragment, evenly distributed, of length `reach`. */
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
		return; /* below the horizon of a faceted surface: neither open nor occluded */
	stage_ray(&p, d, from, &a->rays[item]);
	a->rays[item].t_max = a->reach;
}

/* --- Results ----------------------------------------------------------------------------------------------------- */

/*
 * shadow_sum: visibility of lights: rays that nothing stopped add `weight`. first: of this list. Of the others, those
 * that may continue are set to 1: all of them (through), or those whose surfaces have to be sampled
 * (kernels/rays/opacity.h) or may belong to the body that the ray lights.
 */
static inline void shadow_sum_item(const struct shadow_sum_arguments *a, uint32_t item)
{
	float share = a->occluded[item] ? 0.0f : a->weight;

	if (a->occluded[item])
		a->occluded[item] = a->through || a->occluded[item] == 2u || shadow_begins_within(&a->rays[item]) ? 1u : 0u;

	for (uint32_t c = 0u; c < 3u; c++)
		a->visibility[item * 3u + c] = a->first ? share : a->visibility[item * 3u + c] + share;
}

/* shadow_start: compacts stopped rays into a list, to continue through what lets light pass. */
static inline void shadow_start_item(const struct shadow_start_arguments *a, uint32_t item)
{
	GLOBAL struct path *w;

	if (!a->occluded[item])
		return;
	w = &a->shadow_paths[a->places[item]];
	a->shadow_rays[a->places[item]] = a->rays[item];
	v3_store(w->weight, v3(a->weight, a->weight, a->weight));
	w->target = item;
	w->kind = (uint32_t)shadow_begins_within(&a->rays[item]);
	w->depth = 0u;
	w->medium = SCENE_NONE;
}

/* 1 if a ray that starts inside a lit body leaves it, through the side that the triangle's normals face. */
static inline int shadow_leaves_body(const struct tables *t, const struct hit *hit, GLOBAL const struct ray *ray)
{
	struct vec3 d = v3_load(ray->d), plane, sum;
	struct point p = point_from_hit(t, hit, d);

	plane = point_plane_normal(&p);
	sum = v3_add(v3_add(point_corner_normal(t, &p, 0u), point_corner_normal(t, &p, 1u)), point_corner_normal(t, &p, 2u));
	return (p.material->lighting || p.material->program_normals) && v3_dot(plane, sum) * v3_dot(plane, d) > 0.0f;
}

/* 1 if a hit is on the edge of its triangle, as far as rays can tell. */
static inline int shadow_is_on_edge(const struct hit *hit)
{
	return M_MIN(M_MIN(hit->b1, hit->b2), 1.0f - hit->b1 - hit->b2) <= RAYS_EDGE_SLACK;
}

/* 1 if a ray that goes through an edge has met the same surface in the triangle beside it. */
static inline int shadow_is_met(const struct hit *hit, GLOBAL const struct hit *last)
{
	struct hit before = *last;

	return before.instance == hit->instance && hit->t - before.t <= RAYS_END_SLACK * hit->t && shadow_is_on_edge(hit) &&
	       shadow_is_on_edge(&before);
}

/*
 * shadow_walk: continues past the surface that a ray to a light hit, or ends the ray. A path's kind is 1 while the ray
 * may still be inside the body that it lights.
 */
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
	if (w.kind && shadow_leaves_body(t, &hit, &a->rays[item]))
		w.kind = 0u;
	else if (!(a->after && shadow_is_met(&hit, &a->last[item])))
		weight = v3_mul(weight, transparency_of_hit(t, &hit, &a->rays[item], a->to_lights));
	if (!(v3_most(weight) > a->least))
		return;
	a->next_rays[item] = a->rays[item];
	a->next_rays[item].t_min = hit.t; /* other surfaces may be there as well */
	a->next_paths[item] = w;
	v3_store(a->next_paths[item].weight, weight);
	a->counts[item] = 1u;
}

/* ao_shade: stores how open a fragment's surroundings are, as its colour or multiplied with it. */
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
