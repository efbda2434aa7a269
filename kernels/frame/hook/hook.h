/*
 * Calls of a user's hook functions (tracer/hook/hook.h reads them; corpus/hooks/README.md is for their authors). Each
 * function takes plain structs and says what becomes of a ray; kernels carry it out. Nothing here is compiled unless
 * there is a hook.
 *
 *   hook_ray        ray generation: a pixel's first ray, replacing the camera's
 *   hook_see        first hits of these rays, for channels Z, N, P and id
 *   hook_store      stores what they found in the frame
 *   hook_shade      any hit and closest hit, for fragments: after they were lit, before their rays leave
 *   hook_ways       the rays that hook_shade's hook asked for, replacing a fragment's own
 *   hook_hit        any hit, closest hit and miss, for paths: after shade_hit
 *   hook_walk       any hit, for rays to lights: after shadow_walk
 *   hook_light      light, for fragments: after their rays to lights
 *   hook_light_hit  the same, for hits
 *
 * The built-in colour is what the preceding kernels computed, and a hook that returns it unchanged changes no bit. The
 * twins have no hook, so they do what kernels do if a hook always returns the built-in result.
 */
#pragma once

#include "kernels/frame/hook/hook_text.h"

/* --- Calling the hook's functions -------------------------------------------------------------------------------- */

static inline struct hook_answer hook_no_answer(void)
{
	struct hook_answer a;

	a.what = 0u;
	for (int i = 0; i < 3; i++)
		a.color[i] = a.direction[i] = a.weight[i] = 0.0f;
	return a;
}

static inline struct vec3 hook_color(const struct hook_answer *a)
{
	return v3(a->color[0], a->color[1], a->color[2]);
}

/* The ray that a hook is called for: it hit the surface, or met nothing. */
struct hook_way {
	struct vec3 origin, direction; /* unit length */
	float distance;
	uint32_t depth, shadow; /* shadow: 1 for a ray to a light */
	struct vec3 color; /* the built-in colour */
};

#ifdef __OPENCL_VERSION__
static inline struct relume_hit hook_hit_of(const struct hook_place *at, const struct hook_way *way)
{
	struct relume_hit hit;

	hit.position = hook_float4(point_position(at->point));
	hit.normal = hook_float4(point_normal(at->point));
	hit.direction = hook_float4(way->direction);
	hit.color = hook_float4(way->color);
	hit.distance = way->distance;
	hit.depth = way->depth;
	hit.draw = at->point->geometry->draw;
	hit.front = (uint)at->point->front;
	hit.shadow = way->shadow;
	hit.place = at;
	return hit;
}
#endif

/* Any hit. @return 1: the ray ignores the surface. row: the surface's parameters */
static inline int hook_ignores(const struct hook_place *at, const struct hook_way *way, GLOBAL const float *row)
{
#if defined(__OPENCL_VERSION__) && defined(HOOK_ANY_HIT)
	return (any_hit(hook_hit_of(at, way), hook_parameters(row)).what & RELUME_IGNORE) != 0u;
#else
	(void)at;
	(void)way;
	(void)row;
	return 0;
#endif
}

static inline struct hook_answer hook_ask_hit(const struct hook_place *at, const struct hook_way *way,
                                              GLOBAL const float *row)
{
#if defined(__OPENCL_VERSION__) && defined(HOOK_CLOSEST_HIT)
	return hook_answer_of(closest_hit(hook_hit_of(at, way), hook_parameters(row)));
#else
	(void)at;
	(void)way;
	(void)row;
	return hook_no_answer();
#endif
}

static inline struct hook_answer hook_ask_miss(const struct hook_way *way, GLOBAL const float *row)
{
#if defined(__OPENCL_VERSION__) && defined(HOOK_MISS)
	struct relume_miss missed;

	missed.origin = hook_float4(way->origin);
	missed.direction = hook_float4(way->direction);
	missed.color = hook_float4(way->color);
	missed.depth = way->depth;
	return hook_answer_of(miss(missed, hook_parameters(row)));
#else
	(void)way;
	(void)row;
	return hook_no_answer();
#endif
}

/* --- Ray generation ---------------------------------------------------------------------------------------------- */

/*
 * The first ray of a pixel: the program's camera's, or the hook's in its place. The view of this pass may be shifted
 * within the pixel (prepare_shift). @return 0: there is no ray
 */
static inline int hook_first_ray(const struct hook_ray_arguments *a, uint32_t number, struct vec3 *o, struct vec3 *d)
{
	GLOBAL const struct view *view = &a->views[a->view_index];
	const uint32_t x = number % a->width, y = number / a->width;
	const float nx = 2.0f * ((float)x + 0.5f - view->viewport[0]) / view->viewport[2] - 1.0f;
	const float ny = 2.0f * ((float)y + 0.5f - view->viewport[1]) / view->viewport[3] - 1.0f;
	const struct vec4 near = m4_mul(view->inverse, v4(nx, ny, -1.0f, 1.0f));

	*o = v3_scale(v3(near.x, near.y, near.z), 1.0f / near.w);
	*d = v3_normalize(stage_view_direction(view, x, y));
#if defined(__OPENCL_VERSION__) && defined(HOOK_RAY_GENERATION)
	{
		struct relume_pixel pixel;
		struct relume_ray ray;
		float u = 0.5f, v = 0.5f;

		if (a->sample)
			sample_take(a->frame_number, sample_hash(number) + SAMPLE_JITTER, a->sample, &u, &v);
		pixel.x = (float)x + u;
		pixel.y = (float)(a->height - y) - v;
		pixel.width = a->width;
		pixel.height = a->height;
		sample_take(a->frame_number, sample_hash(number) + SAMPLE_GLOSS, a->sample, &pixel.u, &pixel.v);
		pixel.ray.origin = hook_float4(*o);
		pixel.ray.direction = hook_float4(*d);
		ray = ray_generation(pixel, hook_parameters(a->parameters + a->row));
		*o = hook_vec3(ray.origin);
		*d = v3_normalize(hook_vec3(ray.direction));
	}
#endif
	return v3_dot(*d, *d) > 0.0f;
}

static inline void hook_ray_item(const struct hook_ray_arguments *a, uint32_t item)
{
	const uint32_t number = a->first_pixel + stage_pixel(a->rectangle, a->width, item);
	GLOBAL struct shaded *s = &a->shaded[item];
	GLOBAL struct path *path = &a->next_paths[item];
	struct vec3 o, d;

	a->pixels[item] = number;
	a->counts[item] = 0u;
	s->flags = 0u;
	if (!sample_takes_part(number, a->turn))
		return;
	s->flags = SHADED_THERE;
	stage_store_direct(s, v3(0.0f, 0.0f, 0.0f));
	if (!hook_first_ray(a, number, &o, &d))
		return;
	v3_store(a->next_rays[item].o, o);
	v3_store(a->next_rays[item].d, d);
	a->next_rays[item].t_min = 0.0f;
	a->next_rays[item].t_max = 1.0e30f;
	v3_store(path->weight, v3(1.0f, 1.0f, 1.0f));
	path->target = item;
	path->kind = PATH_REFRACT;
	path->depth = 0u;
	path->medium = SCENE_NONE;
	path->density = 0.0f;
	a->counts[item] = 1u;
}

static inline void hook_see_item(const struct hook_see_arguments *a, uint32_t item)
{
	GLOBAL struct frame_pixel *pixel = &a->frame[a->pixels[a->paths[item].target] - a->first_pixel];
	const struct hit hit = a->hits[item];
	struct texturing texturing;
	struct vec4 albedo;
	struct point p;

	if (hit.instance == SCENE_NONE)
		return;
	p = point_from_hit(&a->tables, &hit, v3_load(a->rays[item].d));
	point_texture(&a->tables, &p, (const struct point_window *)0, &texturing);
	albedo = point_albedo(&a->tables, &p, &texturing);
	v3_store(pixel->albedo, v3(albedo.x, albedo.y, albedo.z));
	pixel->surface.order = 0u;
	pixel->surface.instance = hit.instance;
	pixel->surface.primitive = hit.primitive | FRAGMENT_PERSPECTIVE;
	pixel->surface.b1 = hit.b1;
	pixel->surface.b2 = hit.b2;
	pixel->surface.depth = 0.0f;
	pixel->id = stage_draw(&a->tables, hit.instance, hit.primitive);
}

static inline void hook_store_item(const struct hook_store_arguments *a, uint32_t item)
{
	GLOBAL struct frame_pixel *pixel = &a->frame[a->pixels[item] - a->first_pixel];

	if (!(a->shaded[item].flags & SHADED_THERE))
		return;
	for (uint32_t c = 0u; c < 3u; c++)
		pixel->gl[c] = pixel->shadowed[c] = pixel->direct[c] = pixel->mirrored[c] = pixel->beauty[c] =
			a->shaded[item].beauty[c];
	pixel->gl[3] = 1.0f;
	pixel->unknown &= ~PIXEL_UNKNOWN_COLOR;
}

/* --- Closest hit, and miss --------------------------------------------------------------------------------------- */

static inline int hook_differs(struct vec3 a, struct vec3 b)
{
	return a.x != b.x || a.y != b.y || a.z != b.z;
}

/* The row of parameters of a material. */
static inline GLOBAL const float *hook_row(GLOBAL const float *parameters, uint32_t words, const struct point *p)
{
	return parameters + (size_t)p->geometry->material * words;
}

/* Any hit, then closest hit. in_part: 1: only any hit is called for this surface */
static inline struct hook_answer hook_ask(const struct hook_place *at, const struct hook_way *way,
                                          GLOBAL const float *row, int in_part)
{
	struct hook_answer answer = hook_no_answer();

	if (hook_ignores(at, way, row))
		answer.what = RELUME_IGNORE;
	else if (!in_part)
		answer = hook_ask_hit(at, way, row);
	return answer;
}

static inline void hook_shade_item(const struct hook_shade_arguments *a, uint32_t item)
{
	const struct fragment f = a->fragments[item];
	GLOBAL struct shaded *s = &a->shaded[item];
	struct hook_way way;
	struct hook_answer answer;
	struct point p;
	const struct hook_place at = { &a->tables, &p, a->visibility, a->n_slots, a->n, item, a->transport, &a->trees };

	a->answers[item].what = 0u;
	if (!(s->flags & SHADED_THERE))
		return;
	p = point_from_fragment(&a->tables, a->windows, &f);
	if (p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	way.origin = v3(0.0f, 0.0f, 0.0f);
	way.direction = v3_normalize(stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width,
	                                                  a->pixels[item] / a->width));
	way.distance = M_SQRT(v3_dot(point_position(&p), point_position(&p)));
	way.depth = way.shadow = 0u;
	way.color = stage_light(a->transport, v3_load(s->direct));
	answer = hook_ask(&at, &way, hook_row(a->parameters, a->words, &p), 0);
	if (!answer.what)
		return;
	a->answers[item] = answer;
	if (hook_differs(hook_color(&answer), way.color))
		stage_store_direct(s, stage_number(a->transport, hook_color(&answer)));
}

static inline void hook_ways_item(const struct hook_ways_arguments *a, uint32_t item)
{
	const struct fragment f = a->fragments[item];
	const struct hook_answer answer = a->answers[item];
	GLOBAL struct shaded *s = &a->shaded[item];
	GLOBAL struct ray *ray;
	struct branches b;
	struct point p;
	struct vec3 d;
	int through = (answer.what & RELUME_IGNORE) != 0u;

	if (!(s->flags & SHADED_THERE) || !(answer.what & (RELUME_RAY | RELUME_IGNORE)))
		return;
	stage_store_direct(s, stage_number(a->transport, hook_color(&answer)));
	p = point_from_fragment(&a->tables, a->windows, &f);
	d = v3_normalize(stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width,
	                                      a->pixels[item] / a->width));
	b = branches_of_fragment(a->next_rays, a->next_paths, item);
	ray = branch(&b, through ? v3(1.0f, 1.0f, 1.0f) : v3(answer.weight[0], answer.weight[1], answer.weight[2]),
	             PATH_REFLECT, SCENE_NONE);
	if (ray)
		stage_ray(&p, through ? d : v3_normalize(v3(answer.direction[0], answer.direction[1], answer.direction[2])), d, ray);
	if (ray && through)
		b.paths[0].depth = 0u;
	a->counts[item] = b.count;
}

/*
 * The factor from a surface's own colour to its part of a path's light: the path's weight, times the share that mirror
 * and glass leave to the surface. A SCENE_NEAR_MIRROR keeps the mirror's share too.
 */
static inline struct vec3 hook_share(const struct hook_hit_arguments *a, uint32_t item, const struct point *p,
                                     struct vec3 weight)
{
	GLOBAL const struct scene_material *m = p->material;
	struct split split;

	if (!(m->surface.reflect > 0.0f || m->surface.transmit > 0.0f))
		return weight;
	split = split_light(p, v3_load(a->rays[item].d));
	return v3_scale(weight, m->surface.hidden & SCENE_NEAR_MIRROR ? split.base + split.mirrored : split.base);
}

static inline float hook_part(float light, float share)
{
	return share > 0.0f ? light / share : 0.0f;
}

/* The surface's own colour that led to the path's light: light / share, per channel. */
static inline struct vec3 hook_given(GLOBAL const float *light, struct vec3 share)
{
	return v3(hook_part(light[0], share.x), hook_part(light[1], share.y), hook_part(light[2], share.z));
}

static inline void hook_miss_path(const struct hook_hit_arguments *a, uint32_t item, struct hook_way *way)
{
	const struct vec3 weight = v3_load(a->paths[item].weight);
	struct hook_answer answer;

	if (a->paths[item].kind == PATH_NEAR)
		return;
	way->color = hook_given(a->radiance + item * 3u, weight);
	answer = hook_ask_miss(way, a->parameters + a->row);
	if (answer.what & RELUME_COLOR && hook_differs(hook_color(&answer), way->color))
		v3_store(a->radiance + item * 3u, v3_mul(weight, hook_color(&answer)));
}

/* Apply a hook's answer for a hit to the path's light and its next rays. */
static inline void hook_obey(const struct hook_hit_arguments *a, uint32_t item, const struct point *p,
                             const struct hook_answer *answer, struct vec3 weight)
{
	const struct vec3 d = v3_load(a->rays[item].d),
			  on = v3(answer->direction[0], answer->direction[1], answer->direction[2]);
	GLOBAL struct ray *ray = (GLOBAL struct ray *)0;
	struct branches b;

	b = branches_of_path(a->paths[item], a->next_rays, a->next_paths, item);
	v3_store(a->radiance + item * 3u, v3_mul(weight, hook_color(answer)));
	if (answer->what & RELUME_IGNORE)
		branch_on(&b, &a->rays[item], a->hits[item].t, weight);
	else if (b.from.depth < a->depth)
		ray = branch(&b, v3_mul(weight, v3(answer->weight[0], answer->weight[1], answer->weight[2])),
		             b.from.kind == PATH_NEAR ? PATH_REFLECT : b.from.kind, b.from.medium);
	if (ray)
		stage_ray(p, v3_normalize(on), d, ray);
	a->counts[item] = b.count;
}

static inline void hook_hit_item(const struct hook_hit_arguments *a, uint32_t item)
{
	const struct hit hit = a->hits[item];
	const struct path path = a->paths[item];
	struct vec3 d = v3_load(a->rays[item].d), weight = path_weight(&path), share;
	struct hook_way way;
	struct hook_answer answer;
	struct point p;
	const struct hook_place at = { &a->tables, &p, a->visibility, a->n_slots, a->n, item, a->transport, &a->trees };

	way.origin = v3_load(a->rays[item].o);
	way.direction = v3_normalize(d);
	way.depth = path.depth;
	way.shadow = 0u;
	if (hit.instance == SCENE_NONE) {
		hook_miss_path(a, item, &way);
		return;
	}
	p = point_from_hit(&a->tables, &hit, d);
	way.distance = hit.t * M_SQRT(v3_dot(d, d));
	if (path.medium != SCENE_NONE)
		weight = v3_mul(weight, glass_absorb(&a->tables.materials[path.medium], hit.t - a->rays[item].t_min));
	share = hook_share(a, item, &p, weight);
	way.color = hook_given(a->radiance + item * 3u, share);
	answer = hook_ask(&at, &way, hook_row(a->parameters, a->words, &p),
	                  p.geometry->flags & GEOMETRY_EXPANDED || transparency_is_unseen(p.material) ||
	                  p.material->alpha_test ||
	                  (p.material->blend && !(p.material->surface.hidden & SCENE_SOLID)) || point_clipped(&p));
	if (answer.what & (RELUME_RAY | RELUME_IGNORE))
		hook_obey(a, item, &p, &answer, weight);
	else if (answer.what && hook_differs(hook_color(&answer), way.color))
		v3_store(a->radiance + item * 3u, v3_mul(share, hook_color(&answer)));
}

/* Continue a ray to a light behind a surface that the hook ignores, whatever shadow_walk did there. */
static inline void hook_walk_item(const struct hook_walk_arguments *a, uint32_t item)
{
	const struct hit hit = a->hits[item];
	const struct vec3 d = v3_load(a->rays[item].d);
	struct hook_way way;
	struct point p;
	/* No slots: the visibility is any buffer. */
	const struct hook_place at = { &a->tables, &p, a->parameters, 0u, 0u, 0u, a->transport, (const struct hook_trees *)0 };

	if (hit.instance == SCENE_NONE)
		return;
	p = point_from_hit(&a->tables, &hit, d);
	way.origin = v3_load(a->rays[item].o);
	way.direction = v3_normalize(d);
	way.distance = hit.t * M_SQRT(v3_dot(d, d));
	way.depth = 0u;
	way.shadow = 1u;
	way.color = v3(0.0f, 0.0f, 0.0f);
	if (!hook_ignores(&at, &way, hook_row(a->parameters, a->words, &p)))
		return;
	a->next_rays[item] = a->rays[item];
	a->next_rays[item].t_min = hit.t;
	a->next_paths[item] = a->paths[item];
	a->counts[item] = 1u;
}

/* --- Light ------------------------------------------------------------------------------------------------------- */

/*
 * Scale the light of one light source that arrives at a point by the hook's factor. number: the light's index among the
 * point's
 */
static inline void hook_dim(const struct tables *t, const struct point *p, uint32_t number, uint32_t transport,
                            GLOBAL const float *row, GLOBAL float *visibility)
{
#if defined(__OPENCL_VERSION__) && defined(HOOK_LIGHT)
	GLOBAL const struct scene_light *source = &t->lights[point_lights(p).first + number];
	const struct vec3 at = point_position(p);
	struct vec3 to_light;
	const float strength = light_strength(source, at, &to_light), w = source->position_eye[3];
	struct relume_beam beam;
	struct relume_request r;

	beam.position = hook_float4(at);
	beam.normal = hook_float4(point_normal(p));
	beam.direction = hook_float4(to_light);
	beam.color = hook_float4(stage_light(transport, v3_scale(v3_load(source->diffuse), strength)));
	beam.axis = hook_float4(source->spot_cutoff_deg == 180.0f ? v3(0.0f, 0.0f, 0.0f) :
	                                                            v3_normalize(v3_load(source->spot_direction_eye)));
	beam.distance = w != 0.0f ? length(hook_float4(v3_load(source->position_eye)) / w - beam.position) : INFINITY;
	beam.number = source->index;
	beam.draw = p->geometry->draw;
	r = light(beam, hook_parameters(row));
	if (r.what & RELUME_COLOR)
		v3_store(visibility, v3_mul(v3_load(visibility), v3(clamp01(r.color.x), clamp01(r.color.y), clamp01(r.color.z))));
#else
	(void)t;
	(void)p;
	(void)number;
	(void)transport;
	(void)row;
	(void)visibility;
#endif
}

/* Test whether a ray to a light was sent and some of the light arrived. */
static inline int hook_is_lit(GLOBAL const struct ray *ray, GLOBAL const float *visibility)
{
	return ray->t_min <= ray->t_max && v3_most(v3_load(visibility)) > 0.0f;
}

static inline void hook_light_item(const struct hook_light_arguments *a, uint32_t item)
{
	const struct fragment f = a->fragments[item % a->n];
	struct point p;

	if (!hook_is_lit(&a->rays[item], a->visibility + item * 3u))
		return;
	p = point_from_fragment(&a->tables, a->windows, &f);
	hook_dim(&a->tables, &p, item / a->n, a->transport, hook_row(a->parameters, a->words, &p), a->visibility + item * 3u);
}

static inline void hook_light_hit_item(const struct hook_light_hit_arguments *a, uint32_t item)
{
	const struct hit hit = a->hits[item % a->n];
	struct point p;

	if (!hook_is_lit(&a->rays[item], a->visibility + item * 3u))
		return;
	p = point_from_hit(&a->tables, &hit, v3_load(a->path_rays[item % a->n].d));
	hook_dim(&a->tables, &p, item / a->n, a->transport, hook_row(a->parameters, a->words, &p), a->visibility + item * 3u);
}
