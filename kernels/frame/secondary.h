/*
 * One work item of each kernel that sends rays from fragments and from what their rays hit: to lights, mirrored, through
 * glass, scattered. All on the list of fragments (gl_stages.h) and on lists of paths (struct path): a path's next rays are
 * written apart, so many places each, and gathered into the next list in the order of their paths, so that the paths of
 * a fragment stay side by side and sums do not depend on scheduling.
 */
#ifndef KERNELS_FRAME_SECONDARY_H
#define KERNELS_FRAME_SECONDARY_H

#include "kernels/gl/stages.h"
#include "kernels/frame/sample.h"

/* Less of a pixel than this is not followed: a quarter of a step of 8 bits. */
#define PATH_LEAST 0.0009765625f

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

/* What rays from the fragments of a triangle share, found for the first of them. */
struct stage_kept_plane {
	uint32_t instance, primitive; /* the fragments'; SCENE_NONE: nothing is kept */
	struct point p;               /* but for its weights */
	float w_inv[3];
	struct point_plane plane;
};

/*
 * shadow_ray: rays[slot * n + i] goes from fragment i to the light in a slot; an empty ray where none is wanted.
 * sample: which of the rays to each light, over all passes of the frame. keeps, kept: as for shade_item.
 */
static inline void shadow_ray_item(const struct shadow_ray_arguments *a, uint32_t item, int keeps, struct stage_kept_plane *kept)
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

/* --- What lets light through -------------------------------------------------------------------------------------- */

/* Blending as gl_blend.h does it, but of light, which has no 8 bits to be rounded to. */
static inline struct vec4 veil_factor(uint32_t factor, struct vec4 s, struct vec4 d, struct vec4 c)
{
	float f;

	switch (factor) {
	case GL_ZERO: return v4(0.0f, 0.0f, 0.0f, 0.0f);
	case GL_SRC_COLOR: return s;
	case GL_ONE_MINUS_SRC_COLOR: return v4(1.0f - s.x, 1.0f - s.y, 1.0f - s.z, 1.0f - s.w);
	case GL_DST_COLOR: return d;
	case GL_ONE_MINUS_DST_COLOR: return v4(1.0f - d.x, 1.0f - d.y, 1.0f - d.z, 1.0f - d.w);
	case GL_SRC_ALPHA: return v4(s.w, s.w, s.w, s.w);
	case GL_ONE_MINUS_SRC_ALPHA: f = 1.0f - s.w; return v4(f, f, f, f);
	case GL_DST_ALPHA: return v4(d.w, d.w, d.w, d.w);
	case GL_ONE_MINUS_DST_ALPHA: f = 1.0f - d.w; return v4(f, f, f, f);
	case GL_CONSTANT_COLOR: return c;
	case GL_ONE_MINUS_CONSTANT_COLOR: return v4(1.0f - c.x, 1.0f - c.y, 1.0f - c.z, 1.0f - c.w);
	case GL_CONSTANT_ALPHA: return v4(c.w, c.w, c.w, c.w);
	case GL_ONE_MINUS_CONSTANT_ALPHA: f = 1.0f - c.w; return v4(f, f, f, f);
	case GL_SRC_ALPHA_SATURATE: f = M_MIN(s.w, 1.0f - d.w); return v4(f, f, f, 1.0f);
	default: return v4(1.0f, 1.0f, 1.0f, 1.0f);
	}
}

static inline struct vec4 veil_equation(uint32_t equation, struct vec4 s, struct vec4 fs, struct vec4 d,
                                        struct vec4 fd)
{
	switch (equation) {
	case GL_FUNC_SUBTRACT: return v4_sub(v4_mul(s, fs), v4_mul(d, fd));
	case GL_FUNC_REVERSE_SUBTRACT: return v4_sub(v4_mul(d, fd), v4_mul(s, fs));
	case GL_MIN: return v4(M_MIN(s.x, d.x), M_MIN(s.y, d.y), M_MIN(s.z, d.z), M_MIN(s.w, d.w));
	case GL_MAX: return v4(M_MAX(s.x, d.x), M_MAX(s.y, d.y), M_MAX(s.z, d.z), M_MAX(s.w, d.w));
	default: return v4_add(v4_mul(s, fs), v4_mul(d, fd));
	}
}

/* What comes of a colour over a destination, without clamping. */
static inline struct vec3 veil_blend(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d)
{
	struct vec4 c = v4_load(m->blend_color);
	struct vec4 rgb = veil_equation(m->blend_equation_rgb, s, veil_factor(m->blend_src_rgb, s, d, c), d,
	                                veil_factor(m->blend_dst_rgb, s, d, c));

	return v3(rgb.x, rgb.y, rgb.z);
}

static inline struct vec3 veil_clamp(struct vec3 a)
{
	return v3(clamp01(a.x), clamp01(a.y), clamp01(a.z));
}

/* What of the light from behind a blended surface comes through it: how much the outcome follows the destination. */
static inline struct vec3 veil_pass(GLOBAL const struct scene_material *m, struct vec4 color)
{
	struct vec3 over = veil_blend(m, color, v4(1.0f, 1.0f, 1.0f, 1.0f));

	return veil_clamp(v3_sub(over, veil_blend(m, color, v4(0.0f, 0.0f, 0.0f, 0.0f))));
}

/* 1 where GL draws nothing of the primitive at this point: clipped, or its alpha test fails. */
static inline int veil_is_hole(const struct point *p, float alpha)
{
	return point_clipped(p) || (p->material->alpha_test && !pixel_compare(p->material->alpha_func, blend_round(alpha),
	                                                                   blend_round(p->material->alpha_ref)));
}

/* Unpolarised light that a boundary reflects (Fresnel); eta: index on this side over that beyond, cosine on this side. */
static inline float glass_fresnel(float eta, float cosine, float *cosine_beyond)
{
	float k = 1.0f - eta * eta * (1.0f - cosine * cosine), across, along;

	*cosine_beyond = 0.0f;
	if (!(k > 0.0f))
		return 1.0f; /* total reflection */
	*cosine_beyond = M_SQRT(k);
	across = (eta * cosine - *cosine_beyond) / (eta * cosine + *cosine_beyond);
	along = (cosine - eta * *cosine_beyond) / (cosine + eta * *cosine_beyond);
	return 0.5f * (across * across + along * along);
}

static inline float glass_ior(GLOBAL const struct scene_material *m)
{
	return m->surface.ior > 0.0f ? m->surface.ior : 1.0f;
}

/* The colour of a surface that lets light through: half of it at each of the two surfaces of a body. */
static inline struct vec3 glass_tint(const struct tables *t, const struct point *p, const struct coat *coat)
{
	struct vec4 c = point_albedo(t, p, coat);

	return v3(M_SQRT(clamp01(c.x)), M_SQRT(clamp01(c.y)), M_SQRT(clamp01(c.z)));
}

static inline struct vec3 glass_absorb(GLOBAL const struct scene_material *m, float length)
{
	return v3(M_EXP(-m->surface.absorb[0] * length), M_EXP(-m->surface.absorb[1] * length),
	          M_EXP(-m->surface.absorb[2] * length));
}

/* What of a light's ray comes past the surface that it hit; all of it where that casts no shadow. */
static inline struct vec3 veil_light(const struct tables *t, const struct hit *hit, GLOBAL const struct ray *ray)
{
	struct vec3 d = v3_load(ray->d), none = v3(0.0f, 0.0f, 0.0f), all = v3(1.0f, 1.0f, 1.0f), pass;
	struct point p = point_from_hit(t, hit, d);
	GLOBAL const struct scene_material *m = p.material;
	struct coat coat;
	struct lit lit;
	struct vec4 color;
	float cosine, beyond;

	if (m->surface.hidden & 1u)
		return all;
	if (!m->alpha_test && !m->blend && !(m->surface.transmit > 0.0f) && !m->clip_plane_mask)
		return none;
	point_coat(t, &p, (GLOBAL const struct view *)0, (const struct clip_setup *)0, (struct point_kept *)0, 0u, 0u, 0u, &coat);
	lit = point_lit_from_vertices(&p);
	color = point_finish(t, &p, &coat, &lit);
	if (veil_is_hole(&p, color.w))
		return all;
	if (m->surface.transmit > 0.0f) {
		cosine = M_ABS(v3_dot(point_normal(&p), v3_normalize(d)));
		pass = v3_scale(glass_tint(t, &p, &coat), clamp01(m->surface.transmit) *
		                (1.0f - glass_fresnel(1.0f / glass_ior(m), cosine, &beyond)));
		if (!p.front) /* on its way out: through the body since the last surface */
			pass = v3_mul(pass, glass_absorb(m, (hit->t - ray->t_min) * M_SQRT(v3_dot(d, d))));
		return pass;
	}
	if (!m->blend)
		return none;
	/* Blended draws that leave no depth are light or film (glows, blob shadows), nothing that stands in light's way. */
	return m->depth_write ? veil_pass(m, color) : all;
}

/* The place on a ray from where the next surface is looked for: the same ray meets the last one at the same t again. */
static inline float veil_beyond(float t)
{
	return t > 0.0f ? M_FLOAT(M_BITS(t) + 1u) : 1.0e-37f;
}

/*
 * shadow_sum: shares of light that arrive: rays that nothing stopped add `weight`. first: of this list.
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
	weight = v3_mul(weight, veil_light(t, &hit, &a->rays[item]));
	if (!(v3_most(weight) > 0.0f))
		return;
	a->next_rays[item] = a->rays[item];
	a->next_rays[item].t_min = veil_beyond(hit.t);
	a->next_paths[item] = w;
	v3_store(a->next_paths[item].weight, weight);
	a->counts[item] = 1u;
}

/* --- Paths -------------------------------------------------------------------------------------------------------- */

/* gather_paths: next rays to their places in the new list. */
static inline void gather_paths_item(const struct gather_paths_arguments *a, uint32_t item)
{
	for (uint32_t i = 0u; i < a->counts[item]; i++) {
		a->rays[a->places[item] + i] = a->next_rays[item * a->slots + i];
		a->paths[a->places[item] + i] = a->next_paths[item * a->slots + i];
	}
}

/* Where a point's next rays are written. */
struct branches {
	GLOBAL struct ray *rays;
	GLOBAL struct path *paths;
	uint32_t count;
	struct path from; /* the path that ends here; its weight is what arrives */
};

/* The next place of the list, its ray still to be written, or NULL: too little to be followed. */
static inline GLOBAL struct ray *branch(struct branches *b, struct vec3 weight, uint32_t kind, uint32_t medium)
{
	GLOBAL struct path *next = &b->paths[b->count];

	if (!(v3_most(weight) > PATH_LEAST))
		return (GLOBAL struct ray *)0;
	*next = b->from;
	v3_store(next->weight, weight);
	next->kind = kind;
	next->medium = medium;
	next->depth = b->from.depth + 1u;
	return &b->rays[b->count++];
}

/* A direction kept on the side of the surface where it belongs: smooth normals may send it into the plane. */
static inline struct vec3 branch_on_side(struct vec3 d, struct vec3 plane)
{
	float into = v3_dot(d, plane);

	return into < 0.0f ? v3_normalize(v3_sub(d, v3_scale(plane, 1.001f * into))) : d;
}

static inline void branch_mirror(struct branches *b, const struct point *p, struct vec3 d, struct vec3 weight,
                                 uint32_t kind, uint32_t seed, uint32_t sample)
{
	struct vec3 n = point_normal(p), plane = point_plane_normal(p);
	float roughness = p->material->surface.roughness, u, v;
	GLOBAL struct ray *ray = branch(b, weight, kind, b->from.medium);
	struct vec3 away;

	if (!ray)
		return;
	away = v3_sub(d, v3_scale(n, 2.0f * v3_dot(d, n)));
	if (roughness > 0.0f) {
		sample_square(seed + SAMPLE_GLOSS, sample, &u, &v);
		away = v3_normalize(v3_add(away, v3_scale(sample_disk(away, u, v), roughness)));
	}
	plane = v3_dot(plane, d) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	stage_ray(p, branch_on_side(away, plane), d, ray);
}

/* What a surface does with light that arrives along d: shares that it mirrors and lets through; the rest it scatters. */
struct split {
	float mirrored, through, base;
	float eta, cosine, cosine_beyond;
};

static inline struct split split_light(const struct point *p, struct vec3 d)
{
	GLOBAL const struct scene_material *m = p->material;
	struct split s;
	float fresnel = 0.0f;

	s.mirrored = clamp01(m->surface.reflect);
	s.through = M_MIN(clamp01(m->surface.transmit), 1.0f - s.mirrored);
	s.base = 1.0f - s.mirrored - s.through;
	s.eta = p->front ? 1.0f / glass_ior(m) : glass_ior(m);
	s.cosine = clamp01(-v3_dot(point_normal(p), d));
	s.cosine_beyond = 0.0f;
	if (s.through > 0.0f)
		fresnel = glass_fresnel(s.eta, s.cosine, &s.cosine_beyond);
	s.mirrored += s.through * fresnel;
	s.through *= 1.0f - fresnel;
	return s;
}

/* Through the surface, bent (Snell). */
static inline void branch_through(struct branches *b, const struct point *p, struct vec3 d, const struct split *s,
                                  struct vec3 weight, uint32_t kind)
{
	struct vec3 n = point_normal(p), plane = point_plane_normal(p), on;
	GLOBAL struct ray *ray = branch(b, weight, kind, p->front ? (uint32_t)p->geometry->material : SCENE_NONE);

	if (!ray)
		return;
	on = v3_normalize(v3_add(v3_scale(d, s->eta), v3_scale(n, s->eta * s->cosine - s->cosine_beyond)));
	plane = v3_dot(plane, d) < 0.0f ? v3_scale(plane, -1.0f) : plane;
	stage_ray(p, branch_on_side(on, plane), d, ray);
}

static inline void branch_scatter(struct branches *b, const struct point *p, struct vec3 d, struct vec3 weight,
                                  uint32_t kind, uint32_t seed, uint32_t sample)
{
	struct vec3 plane = point_plane_normal(p), on;
	GLOBAL struct ray *ray;
	float u, v;

	sample_square(seed + SAMPLE_BOUNCE, sample, &u, &v);
	on = sample_cosine(point_normal(p), u, v);
	plane = v3_dot(plane, d) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	ray = branch(b, weight, kind, b->from.medium);
	if (ray)
		stage_ray(p, branch_on_side(on, plane), d, ray);
}

static inline struct vec3 path_weight(const struct path *path)
{
	return v3(path->weight[0], path->weight[1], path->weight[2]);
}

/* leave: a fragment's first rays, and what of its own colour stays. */
static inline void leave_item(const struct leave_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct fragment f = a->fragments[item];
	GLOBAL struct shaded *s = &a->shaded[item];
	uint32_t seed = sample_hash(a->pixels[item]);
	struct branches b;
	struct vec3 d, mirrored;
	struct split split;
	struct coat coat;
	struct point p;

	a->counts[item] = 0u;
	if (!(s->flags & SHADED_THERE))
		return;
	p = point_from_fragment(t, a->windows, &f);
	if (p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	if (a->transport < TRANSPORT_DIFFUSE && !(p.material->surface.reflect > 0.0f || p.material->surface.transmit > 0.0f))
		return;
	b.rays = a->next_rays + item * PATHS_PER_FRAGMENT;
	b.paths = a->next_paths + item * PATHS_PER_FRAGMENT;
	b.count = 0u;
	b.from.target = item;
	b.from.depth = 0u;
	b.from.medium = SCENE_NONE;
	d = v3_normalize(stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width, a->pixels[item] / a->width));
	split = split_light(&p, d);
	mirrored = v3_scale(v3_load(s->direct), 1.0f - split.mirrored);
	v3_store(s->mirrored, mirrored);
	v3_store(s->beauty, v3_sub(mirrored, v3_scale(v3_load(s->direct), split.through)));
	if (a->transport >= TRANSPORT_DIFFUSE && point_takes_light(&p))
		branch_scatter(&b, &p, d, v3_scale(v3_load(s->albedo), split.base), PATH_DIFFUSE, seed, a->sample);
	branch_mirror(&b, &p, d, v3_scale(v3(1.0f, 1.0f, 1.0f), split.mirrored), PATH_REFLECT, seed, a->sample);
	if (split.through > 0.0f) {
		point_coat(t, &p, (GLOBAL const struct view *)0, (const struct clip_setup *)0, (struct point_kept *)0, 0u, 0u, 0u, &coat);
		branch_through(&b, &p, d, &split, v3_scale(glass_tint(t, &p, &coat), split.through), PATH_REFRACT);
	}
	a->counts[item] = b.count;
}

/* sky_ray: what hit nothing looks on from the viewer's place: skies are drawn around that, and mean infinity. */
static inline void sky_ray_item(const struct sky_ray_arguments *a, uint32_t item)
{
	stage_no_ray(&a->out[item]);
	if (a->hits[item].instance != SCENE_NONE)
		return;
	v3_store(a->out[item].d, v3_load(a->rays[item].d));
	a->out[item].t_min = 0.0f;
	a->out[item].t_max = 1.0e30f;
}


/* want_lights: what lights a path's hit must ask for. */
static inline void want_lights_item(const struct want_lights_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct hit hit = a->hits[item];
	struct point p;

	a->wanted[item] = 0u;
	if (hit.instance == SCENE_NONE)
		return;
	p = point_from_hit(t, &hit, v3_load(a->rays[item].d));
	a->wanted[item] = stage_wanted(&p, stage_lights(t, &p, a->transport, point_lit_from_vertices(&p).lights));
}

/* The colour of what a path hit, with what arrives of the lights. */
static inline struct vec4 hit_color(const struct tables *t, const struct point *p, const struct coat *coat,
                                    uint32_t transport, const struct vec3 *seen, int dimmed)
{
	struct lit lit;
	struct vec4 color;
	struct vec3 c;

	lit = dimmed && !p->material->surface.relit ? point_lit_again(t, p, seen) : point_lit_from_vertices(p);
	color = point_finish(t, p, coat, &lit);
	c = stage_relit(t, p, coat, transport, seen, color);
	return v4(c.x, c.y, c.z, color.w);
}

/* What is seen where nothing was hit: the sky's surface, if there is one, or the colour the frame was cleared with. */
static inline struct vec3 hit_nothing(const struct tables *t, GLOBAL const struct hit *sky, GLOBAL const struct ray *ray,
                                      uint32_t has_sky, GLOBAL const float *background)
{
	struct hit hit;
	struct point p;
	struct coat coat;
	struct lit lit;
	struct vec4 color;

	if (!has_sky || sky->instance == SCENE_NONE)
		return v3_load(background);
	hit = *sky;
	p = point_from_hit(t, &hit, v3_load(ray->d));
	point_coat(t, &p, (GLOBAL const struct view *)0, (const struct clip_setup *)0, (struct point_kept *)0, 0u, 0u, 0u, &coat);
	lit = point_lit_from_vertices(&p);
	color = point_finish(t, &p, &coat, &lit);
	return v3(color.x, color.y, color.z);
}

/* Onwards past a surface that does not stop the ray: nothing is bent, and it is no bounce. */
static inline void branch_on(struct branches *b, GLOBAL const struct ray *from, float t, struct vec3 weight)
{
	GLOBAL struct ray *ray = branch(b, weight, b->from.kind, b->from.medium);

	if (!ray)
		return;
	b->paths[b->count - 1u].depth = b->from.depth;
	*ray = *from;
	ray->t_min = veil_beyond(t);
}

/*
 * One of the ways on, as often as it carries light. What depth allows is the caller's question.
 */
static inline void branch_one(const struct tables *t, struct branches *b, const struct point *p, struct vec3 d,
                              const struct split *s, const struct coat *coat, struct vec3 weight, uint32_t seed,
                              uint32_t sample)
{
	struct vec4 albedo;
	float u, v;

	sample_square(seed + SAMPLE_CHOICE, sample, &u, &v);
	if (u < s->mirrored) {
		branch_mirror(b, p, d, weight, b->from.kind, seed, sample);
	} else if (u < s->mirrored + s->through) {
		branch_through(b, p, d, s, v3_mul(weight, glass_tint(t, p, coat)), b->from.kind);
	} else if (point_takes_light(p)) {
		albedo = point_albedo(t, p, coat);
		branch_scatter(b, p, d, v3_mul(weight, v3(albedo.x, albedo.y, albedo.z)), b->from.kind, seed, sample);
	}
}

/*
 * shade_hit: what a path found, into given[item]; and the rays that go on from there.
 */
static inline void shade_hit_item(const struct shade_hit_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct hit hit = a->hits[item];
	GLOBAL float *out = a->radiance + item * 3u;
	struct vec3 d = v3_load(a->rays[item].d), seen[SCENE_MAX_LIGHTS], weight, own;
	struct branches b;
	struct point p;
	struct coat coat;
	struct split split;
	struct vec4 color;
	uint32_t seed;
	int dimmed;

	b.from = a->paths[item];
	b.rays = a->next_rays + item * PATHS_PER_HIT;
	b.paths = a->next_paths + item * PATHS_PER_HIT;
	b.count = 0u;
	a->counts[item] = 0u;
	weight = path_weight(&b.from);
	if (hit.instance == SCENE_NONE) {
		v3_store(out, v3_mul(weight, hit_nothing(t, &a->sky[item], &a->rays[item], a->has_sky, a->background)));
		return;
	}
	v3_store(out, v3(0.0f, 0.0f, 0.0f));
	p = point_from_hit(t, &hit, d);
	stage_seen(a->visibility, a->n_slots, a->n, item, seen);
	dimmed = stage_dimmed(a->visibility, a->n_slots, a->n, item);
	point_coat(t, &p, (GLOBAL const struct view *)0, (const struct clip_setup *)0, (struct point_kept *)0, 0u, 0u, 0u, &coat);
	color = hit_color(t, &p, &coat, a->transport, seen, dimmed);
	if (p.material->surface.hidden & 2u || veil_is_hole(&p, color.w)) {
		branch_on(&b, &a->rays[item], hit.t, weight);
		a->counts[item] = b.count;
		return;
	}
	if (b.from.medium != SCENE_NONE)
		weight = v3_mul(weight, glass_absorb(&t->materials[b.from.medium], hit.t - a->rays[item].t_min));
	split = split_light(&p, d);
	own = v3(color.x, color.y, color.z);
	if (p.material->blend && !(split.through > 0.0f)) {
		own = veil_blend(p.material, color, v4(0.0f, 0.0f, 0.0f, 0.0f));
		branch_on(&b, &a->rays[item], hit.t, v3_mul(v3_scale(weight, split.base), veil_pass(p.material, color)));
	}
	v3_store(out, v3_mul(weight, v3_scale(own, split.base)));
	seed = stage_seed(&a->paths[item], a->pixels, 0u);
	if (b.from.depth < a->depth && a->transport == TRANSPORT_PATH && !b.count) {
		branch_one(t, &b, &p, d, &split, &coat, weight, seed, a->sample);
	} else if (b.from.depth < a->depth && a->transport != TRANSPORT_PATH) {
		branch_mirror(&b, &p, d, v3_scale(weight, split.mirrored), b.from.kind, seed, a->sample);
		if (split.through > 0.0f)
			branch_through(&b, &p, d, &split,
			               v3_mul(v3_scale(weight, split.through), glass_tint(t, &p, &coat)), b.from.kind);
	}
	a->counts[item] = b.count;
}

/* credit: what the paths of a fragment found, into its parts. The first path of each fragment sums them up in order. */
static inline void credit_item(const struct credit_arguments *a, uint32_t item)
{
	uint32_t target = a->paths[item].target;
	GLOBAL struct shaded *s = &a->shaded[target];

	if (item > 0u && a->paths[item - 1u].target == target)
		return;
	for (uint32_t i = item; i < a->n && a->paths[i].target == target; i++) {
		struct vec3 light = v3_load(a->radiance + i * 3u);

		if (a->paths[i].kind == PATH_DIFFUSE)
			v3_store(s->direct, v3_add(v3_load(s->direct), light));
		if (a->paths[i].kind != PATH_REFRACT)
			v3_store(s->mirrored, v3_add(v3_load(s->mirrored), light));
		v3_store(s->beauty, v3_add(v3_load(s->beauty), light));
	}
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

#endif
