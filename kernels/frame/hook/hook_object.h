/*
 * Shapes that a user's hook defines by its functions bounds and intersection (corpus/hooks/README.md), replacing
 * instances' triangles.
 *
 *   hook_bounds     bounds: the boxes that limit calls of intersection
 *   hook_intersect  intersection: after the nearest triangle was found
 *   hook_occlude    the same for any hit
 *
 * Code that shades hits only knows triangles, so each hit on a shape becomes a small triangle with three vertices of
 * its own, in a slot that belongs to the ray (tracer/frame/hook/hook_objects.h). A ray tests all objects of its space
 * in turn; they have no tree.
 */
#pragma once

#include "kernels/frame/hook/hook_text.h"

static inline void hook_bounds_item(const struct hook_bounds_arguments *a, uint32_t item)
{
#if defined(__OPENCL_VERSION__) && defined(HOOK_BOUNDS)
	GLOBAL struct hook_object *o = &a->objects[item];
	const struct relume_box box = bounds(hook_object_of(o),
	                                     hook_parameters(a->parameters + (size_t)o->material * a->words));

	v3_store(o->lower, hook_vec3(box.lower));
	v3_store(o->upper, hook_vec3(box.upper));
#else
	(void)a;
	(void)item;
#endif
}

/* A hit that the hook reported. */
struct hook_found {
	float t;                 /* distance, in multiples of the ray's direction */
	struct vec3 normal;      /* object space */
	struct vec4 coordinates; /* texture coordinates */
};

/* Call the hook's intersection for an object, if the ray meets its box between `begin` and `end`. @return 1: it
 * reported a hit there */
static inline int hook_try(GLOBAL const struct hook_object *object, GLOBAL const struct ray *ray, float begin,
                           float end, GLOBAL const float *row, struct hook_found *found)
{
	const struct vec3 o = hook_move(object->obj_from_eye, v3_load(ray->o)),
			  d = hook_turn(object->obj_from_eye, v3_load(ray->d));
	float enter = begin, leave = end;

	if (!(begin <= end) || !hook_meets_box(object->lower, object->upper, o, d, &enter, &leave))
		return 0;
#if defined(__OPENCL_VERSION__) && defined(HOOK_INTERSECTION)
	{
		struct relume_crossing crossing;
		struct relume_request r;

		crossing.ray.origin = hook_float4(o);
		crossing.ray.direction = hook_float4(d);
		crossing.least = begin;
		crossing.most = end;
		crossing.enter = enter;
		crossing.leave = leave;
		crossing.object = hook_object_of(object);
		r = intersection(crossing, hook_parameters(row));
		found->t = r.weight.x;
		found->normal = hook_vec3(r.direction);
		found->coordinates = v4(r.color.x, r.color.y, r.color.z, r.color.w);
		return r.what & RELUME_SURFACE && found->t >= begin && found->t < end;
	}
#else
	(void)row;
	(void)found;
	return 0;
#endif
}

/*
 * A vertex of the triangle that represents a hit on a surface. As in vertex_item, except that texture coordinates come
 * from the hook unless OpenGL generates them.
 */
static inline void hook_vertex(const struct hook_intersect_arguments *a, uint32_t number, uint32_t instance,
                               struct vec3 at, struct vec3 normal, struct vec3 in_object, struct vec4 coordinates)
{
	const struct tables *t = &a->tables;
	GLOBAL const struct geometry *g = &t->geometries[instance];
	GLOBAL const struct scene_material *m = &t->materials[g->material];
	GLOBAL struct shaded_vertex *out = &a->made[g->vertex_first + number];
	const struct vec4 eye = v4(at.x, at.y, at.z, 1.0f);

	v4_store(out->eye, eye);
	v4_store(out->clip, m4_mul(a->views[g->view].projection, eye));
	v3_store(out->normal, normal);
	a->windows[g->vertex_first + number].w_inv = 0.0f; /* no window position: point_shows_front then uses clip space */
	vertex_store_colors(t, g, m, number, out);
	out->fog_coord = vertex_fog_distance(m->fog_coord_source, eye);
	out->size[0] = out->size[1] = 0.0f;
	for (uint32_t i = 0u; i < m->unit_count; i++)
		v4_store(a->made_coords + (g->texcoord_first + number * m->unit_count + i) * 4u,
		         vertex_generated(&t->units[m->unit_first + i], coordinates,
		                          v4(in_object.x, in_object.y, in_object.z, 1.0f), eye, normal));
}

/* Size of the triangle that represents a hit, as a share of its largest coordinate. */
#define HOOK_TRIANGLE 0.00390625f

/* Put a small triangle around the hit into the ray's slot; the hit is its centre. */
static inline void hook_place_triangle(const struct hook_intersect_arguments *a, uint32_t item,
                                       GLOBAL const struct hook_object *object, const struct hook_found *found)
{
	GLOBAL const struct ray *ray = &a->rays[item];
	GLOBAL const float *m = object->obj_from_eye;
	GLOBAL struct hit *hit = &a->hits[item];
	const uint32_t slot = a->first_slot + item, clockwise = a->tables.materials[object->material].front_face == GL_CW;
	const struct vec3 d = v3_load(ray->d), at = v3_add(v3_load(ray->o), v3_scale(d, found->t)), n = found->normal;
	struct vec3 normal = v3_normalize(v3(m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
	                                     m[2] * n.x + m[6] * n.y + m[10] * n.z)), across, along;
	const float size = M_MAX(M_MAX(M_MAX(M_ABS(at.x), M_ABS(at.y)), M_ABS(at.z)), 1.0e-6f) * HOOK_TRIANGLE;

	if (!(v3_dot(normal, normal) > 0.5f))
		normal = v3_scale(v3_normalize(d), -1.0f);
	across = v3_normalize(v3_cross(normal, M_ABS(normal.x) < 0.5f ? v3(1.0f, 0.0f, 0.0f) : v3(0.0f, 1.0f, 0.0f)));
	along = v3_scale(v3_cross(normal, across), clockwise ? -1.0f : 1.0f);
	for (uint32_t i = 0u; i < 3u; i++) {
		const float x = i == 0u ? 1.0f : -0.5f, y = i == 0u ? 0.0f : i == 1u ? 0.8660254f : -0.8660254f;
		const struct vec3 corner = v3_add(at, v3_add(v3_scale(across, x * size), v3_scale(along, y * size)));

		hook_vertex(a, slot * 3u + i, object->instance, corner, normal, hook_move(m, at), found->coordinates);
	}
	hit->t = found->t;
	hit->b1 = hit->b2 = 1.0f / 3.0f;
	hit->instance = object->instance;
	hit->primitive = slot;
}

static inline void hook_intersect_item(const struct hook_intersect_arguments *a, uint32_t item)
{
	GLOBAL struct hit *hit = &a->hits[item];
	/* The same object must not be found again. */
	const float begin = a->after ? ray_beyond(a->rays[item].t_min) : a->rays[item].t_min;
	uint32_t nearest = SCENE_NONE;
	struct hook_found best, found;

	if (a->alone) {
		hit->t = a->rays[item].t_max;
		hit->b1 = hit->b2 = 0.0f;
		hit->instance = hit->primitive = SCENE_NONE;
	}
	best.t = hit->t;
	best.normal = v3(0.0f, 0.0f, 0.0f);
	best.coordinates = v4(0.0f, 0.0f, 0.0f, 1.0f);
	found = best;
	for (uint32_t i = 0u; i < a->n_objects; i++)
		if (hook_try(&a->objects[i], &a->rays[item], begin, best.t,
		             a->parameters + (size_t)a->objects[i].material * a->words, &found)) {
			best = found;
			nearest = i;
		}
	if (nearest != SCENE_NONE)
		hook_place_triangle(a, item, &a->objects[nearest], &best);
}

static inline void hook_occlude_item(const struct hook_occlude_arguments *a, uint32_t item)
{
	struct hook_found found;
	uint32_t stopped = a->alone ? 0u : a->occluded[item];

	for (uint32_t i = 0u; i < a->n_objects && !stopped; i++)
		stopped = hook_try(&a->objects[i], &a->rays[item], a->rays[item].t_min, a->rays[item].t_max,
		                   a->parameters + (size_t)a->objects[i].material * a->words, &found) != 0;
	a->occluded[item] = stopped;
}
