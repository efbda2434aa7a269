/*
 * One work item of each kernel that follows light beyond GL: mirrored, refracted, or scattered from surface to surface.
 * They work on the list of fragments (kernels/gl/stages.h) and on lists of paths (struct path). A path's next rays are
 * first written to a fixed number of places per path, then gathered into the next list in the order of their paths. So
 * the paths of a fragment stay adjacent, and sums do not depend on scheduling.
 */
#pragma once

#include "kernels/frame/light/emitter.h"

/* Smallest share of a pixel that is followed: a quarter of an 8-bit step. */
#define PATH_LEAST 0.0009765625f
/* In mode path, paths that carry less than this survive at random, and then count as this (Russian roulette). */
#define PATH_ROULETTE 0.0625f

/* gather_paths: moves next rays to their places in the new list. */
static inline void gather_paths_item(const struct gather_paths_arguments *a, uint32_t item)
{
	for (uint32_t i = 0u; i < a->counts[item]; i++) {
		a->rays[a->places[item] + i] = a->next_rays[item * a->slots + i];
		a->paths[a->places[item] + i] = a->next_paths[item * a->slots + i];
	}
}

/* gather_hits: moves the hits of the same items to the places of their next rays, one each. */
static inline void gather_hits_item(const struct gather_hits_arguments *a, uint32_t item)
{
	if (a->counts[item])
		a->last[a->places[item]] = a->hits[item];
}

/* Destination of a point's next rays. */
struct branches {
	GLOBAL struct ray *rays;
	GLOBAL struct path *paths;
	uint32_t count;
	struct path from; /* the path that ends here */
};

/* Start with no rays from a fragment. */
static inline struct branches branches_of_fragment(GLOBAL struct ray *next_rays, GLOBAL struct path *next_paths,
                                                   uint32_t item)
{
	struct branches b;

	b.rays = next_rays + item * PATHS_PER_FRAGMENT;
	b.paths = next_paths + item * PATHS_PER_FRAGMENT;
	b.count = 0u;
	b.from.target = item;
	b.from.depth = 0u;
	b.from.medium = SCENE_NONE;
	return b;
}

/* The same at the end of a path. */
static inline struct branches branches_of_path(struct path from, GLOBAL struct ray *next_rays,
                                               GLOBAL struct path *next_paths, uint32_t item)
{
	struct branches b;

	b.rays = next_rays + item * PATHS_PER_HIT;
	b.paths = next_paths + item * PATHS_PER_HIT;
	b.count = 0u;
	b.from = from;
	return b;
}

/* Reserve the next place of the list; the caller writes its ray. NULL: the path carries too little to be followed. */
static inline GLOBAL struct ray *branch(struct branches *b, struct vec3 weight, uint32_t kind, uint32_t medium)
{
	GLOBAL struct path *next = &b->paths[b->count];

	if (!(v3_most(weight) > PATH_LEAST))
		return (GLOBAL struct ray *)0;
	*next = b->from;
	v3_store(next->weight, weight);
	next->kind = kind;
	next->medium = medium;
	next->density = 0.0f;
	next->depth = b->from.depth + 1u;
	return &b->rays[b->count++];
}

/* A direction kept on the right side of the surface, since smooth normals may point it into the plane. */
static inline struct vec3 branch_on_side(struct vec3 d, struct vec3 plane)
{
	float into = v3_dot(d, plane);

	return into < 0.0f ? v3_normalize(v3_sub(d, v3_scale(plane, 1.001f * into))) : d;
}

/* The normal that a mirror reflects about. For a near mirror, the surface's own normal if it has one, even if GL does
 * not light it. */
static inline struct vec3 branch_normal(const struct point *p)
{
	struct vec3 n = point_normal(p), smooth;

	if (p->material->lighting ||
	    (p->material->surface.hidden & (SCENE_NEAR_MIRROR | SCENE_NO_NORMALS)) != SCENE_NEAR_MIRROR)
		return n;
	smooth = v3_normalize(v3_add(v3_add(v3_scale(v3_load(p->vertex[0]->normal), p->weight[0]),
	                                    v3_scale(v3_load(p->vertex[1]->normal), p->weight[1])),
	                             v3_scale(v3_load(p->vertex[2]->normal), p->weight[2])));
	if (!(v3_dot(smooth, smooth) > 0.0f))
		return n;
	return v3_dot(smooth, n) < 0.0f ? v3_scale(smooth, -1.0f) : smooth;
}

/* Sample numbers for choosing the next rays from a point (sample_take). */
struct branch_samples {
	uint32_t frame, seed, index;
};

static inline void branch_mirror(struct branches *b, const struct point *p, struct vec3 d, struct vec3 weight,
                                 uint32_t kind, const struct branch_samples *at)
{
	struct vec3 n = branch_normal(p), plane = point_plane_normal(p);
	float roughness = p->material->surface.roughness, u, v;
	GLOBAL struct ray *ray = branch(b, weight, kind, b->from.medium);
	struct vec3 away;

	if (!ray)
		return;
	away = v3_sub(d, v3_scale(n, 2.0f * v3_dot(d, n)));
	if (roughness > 0.0f) {
		sample_take(at->frame, at->seed + SAMPLE_GLOSS, at->index, &u, &v);
		away = v3_normalize(v3_add(away, v3_scale(sample_disk(away, u, v), roughness)));
	}
	plane = v3_dot(plane, d) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	stage_ray(p, branch_on_side(away, plane), d, ray);
}

/* How a surface splits light that arrives along d: the shares that it mirrors and transmits; the rest is scattered. */
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
	s.eta = glass_enters(p) ? 1.0f / glass_ior(m) : glass_ior(m);
	s.cosine = clamp01(-v3_dot(point_normal(p), d));
	s.cosine_beyond = 0.0f;
	if (s.through > 0.0f)
		fresnel = glass_fresnel(s.eta, s.cosine, &s.cosine_beyond);
	s.mirrored += s.through * fresnel;
	s.through *= 1.0f - fresnel;
	return s;
}

/* Through the surface, refracted (Snell). */
static inline void branch_through(struct branches *b, const struct point *p, struct vec3 d, const struct split *s,
                                  struct vec3 weight, uint32_t kind)
{
	struct vec3 n = point_normal(p), plane = point_plane_normal(p), on;
	GLOBAL struct ray *ray = branch(b, weight, kind, glass_enters(p) ? (uint32_t)p->geometry->material : SCENE_NONE);

	if (!ray)
		return;
	on = v3_normalize(v3_add(v3_scale(d, s->eta), v3_scale(n, s->eta * s->cosine - s->cosine_beyond)));
	plane = v3_dot(plane, d) < 0.0f ? v3_scale(plane, -1.0f) : plane;
	stage_ray(p, branch_on_side(on, plane), d, ray);
}

static inline void branch_scatter(struct branches *b, const struct point *p, struct vec3 d, struct vec3 weight,
                                  uint32_t kind, const struct branch_samples *at)
{
	struct vec3 plane = point_plane_normal(p), on;
	GLOBAL struct ray *ray;
	float u, v;

	sample_take(at->frame, at->seed + SAMPLE_BOUNCE, at->index, &u, &v);
	on = sample_cosine(point_normal(p), u, v);
	plane = v3_dot(plane, d) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	ray = branch(b, weight, kind, b->from.medium);
	if (!ray)
		return;
	stage_ray(p, branch_on_side(on, plane), d, ray);
	if (!(v3_dot(on, plane) < 0.0f))
		b->paths[b->count - 1u].density = clamp01(v3_dot(point_normal(p), on)) * 0.31830988618f;
}

static inline struct vec3 path_weight(const struct path *path)
{
	return v3(path->weight[0], path->weight[1], path->weight[2]);
}

/* Add the light of one path to a part of a fragment. A path without light changes no bit. */
static inline void credit_part(uint32_t transport, GLOBAL float *part, struct vec3 light)
{
	const struct vec3 was = v3_load(part);

	if (v3_dot(light, light) > 0.0f)
		v3_store(part, stage_number(transport, v3_add(stage_light(transport, was), light)));
}

/* leave: a fragment's first rays, and the rest of its own colour. */
static inline void leave_item(const struct leave_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct fragment f = a->fragments[item];
	GLOBAL struct shaded *s = &a->shaded[item];
	const struct branch_samples at = { a->frame, sample_hash(a->pixels[item]), a->sample };
	struct branches b;
	struct vec3 d, direct, mirrored;
	struct split split;
	struct texturing texturing;
	struct point p;

	a->counts[item] = 0u;
	if (!(s->flags & SHADED_THERE))
		return;
	p = point_from_fragment(t, a->windows, &f);
	if (p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	if (a->transport < TRANSPORT_DIFFUSE && !(p.material->surface.reflect > 0.0f || p.material->surface.transmit > 0.0f))
		return;
	b = branches_of_fragment(a->next_rays, a->next_paths, item);
	d = v3_normalize(stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width,
	                                      a->pixels[item] / a->width));
	split = split_light(&p, d);
	if (a->emission.n_emitters && v3_most(v3_load(a->visibility + item * 3u)) > 0.0f && point_takes_light(&p)) {
		const struct emitter_sample place = { at.frame, at.seed, at.index };

		direct = v3_mul(v3_mul(emitter_light(t, &a->emission, a->transport, &p, d, &place),
		                       v3_load(a->visibility + item * 3u)),
		                stage_light(a->transport, v3_load(s->albedo)));
		credit_part(a->transport, s->direct, direct);
		credit_part(a->transport, s->mirrored, direct);
		credit_part(a->transport, s->beauty, direct);
	}
	if (a->transport != TRANSPORT_LINEAR || split.mirrored > 0.0f || split.through > 0.0f) {
		direct = stage_light(a->transport, v3_load(s->direct));
		mirrored = v3_scale(direct, 1.0f - split.mirrored);
		v3_store(s->mirrored, stage_number(a->transport, mirrored));
		v3_store(s->beauty, stage_number(a->transport, v3_sub(mirrored, v3_scale(direct, split.through))));
	}
	if (a->transport >= TRANSPORT_DIFFUSE && point_takes_light(&p))
		branch_scatter(&b, &p, d, v3_scale(stage_light(a->transport, v3_load(s->albedo)), split.base), PATH_DIFFUSE, &at);
	branch_mirror(&b, &p, d, v3_scale(v3(1.0f, 1.0f, 1.0f), split.mirrored),
	              p.material->surface.hidden & SCENE_NEAR_MIRROR ? PATH_NEAR : PATH_REFLECT, &at);
	if (split.through > 0.0f) {
		point_texture(t, &p, (const struct point_window *)0, &texturing);
		branch_through(&b, &p, d, &split, v3_scale(glass_tint(t, &p, &texturing), split.through), PATH_REFRACT);
	}
	a->counts[item] = b.count;
}

/*
 * sky_ray: paths that hit nothing continue from the viewer's position, since skies are drawn around the viewer and
 * represent infinity.
 */
static inline void sky_ray_item(const struct sky_ray_arguments *a, uint32_t item)
{
	stage_no_ray(&a->out[item]);
	if (a->hits[item].instance != SCENE_NONE)
		return;
	v3_store(a->out[item].d, v3_load(a->rays[item].d));
	a->out[item].t_min = 0.0f;
	a->out[item].t_max = 1.0e30f;
}


/* want_lights: finds the lights whose visibility a path's hit needs. */
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

/* The colour of a path's hit, with its lights' visibility. */
static inline struct vec4 hit_color(const struct tables *t, const struct point *p, const struct texturing *texturing,
                                    uint32_t transport, const struct vec3 *seen, int dimmed)
{
	struct lit lit;
	struct vec4 color;
	struct vec3 c;

	lit = dimmed && !p->material->surface.relit ? point_lit_again(t, p, seen) : point_lit_from_vertices(p);
	color = point_finish(t, p, texturing, &lit);
	c = stage_relit(t, p, texturing, transport, seen, color);
	return v4(c.x, c.y, c.z, color.w);
}

/* Light of a path that hit nothing: the sky's surface if there is one, else the colour that the frame was cleared
 * to. */
static inline struct vec3 hit_nothing(const struct tables *t, uint32_t transport, GLOBAL const struct hit *sky,
                                      GLOBAL const struct ray *ray, uint32_t has_sky, GLOBAL const float *background)
{
	struct hit hit;
	struct point p;
	struct texturing texturing;
	struct lit lit;
	struct vec4 color;

	if (!has_sky || sky->instance == SCENE_NONE)
		return stage_light(transport, v3_load(background));
	hit = *sky;
	p = point_from_hit(t, &hit, v3_load(ray->d));
	point_texture(t, &p, (const struct point_window *)0, &texturing);
	lit = point_lit_from_vertices(&p);
	color = point_finish(t, &p, &texturing, &lit);
	return stage_light(transport, v3(color.x, color.y, color.z));
}

/* Continue past a surface that does not stop the ray, without refraction and without counting a bounce. */
static inline void branch_on(struct branches *b, GLOBAL const struct ray *from, float t, struct vec3 weight)
{
	GLOBAL struct ray *ray = branch(b, weight, b->from.kind, b->from.medium);

	if (!ray)
		return;
	b->paths[b->count - 1u].depth = b->from.depth;
	b->paths[b->count - 1u].density = b->from.density;
	*ray = *from;
	ray->t_min = ray_beyond(t);
}

/* Test whether a path continues. weight: what it carries; increased if the path survives roulette. chance: [0,1) */
static inline int branch_survives(struct vec3 *weight, float chance)
{
	const float share = v3_most(*weight) / PATH_ROULETTE;

	if (!(share < 1.0f))
		return 1;
	if (!(chance < share))
		return 0;
	*weight = v3_scale(*weight, 1.0f / share);
	return 1;
}

/* Choose one of the possible rays, in proportion to the light it carries. The caller checks the depth limit. */
static inline void branch_one(const struct tables *t, uint32_t transport, struct branches *b, const struct point *p,
                              struct vec3 d, const struct split *s, const struct texturing *texturing,
                              struct vec3 weight, const struct branch_samples *at)
{
	struct vec4 albedo;
	float u, v;

	sample_take(at->frame, at->seed + SAMPLE_CHOICE, at->index, &u, &v);
	if (u < s->mirrored) {
		if (branch_survives(&weight, v))
			branch_mirror(b, p, d, weight, b->from.kind, at);
	} else if (u < s->mirrored + s->through) {
		weight = v3_mul(weight, glass_tint(t, p, texturing));
		if (branch_survives(&weight, v))
			branch_through(b, p, d, s, weight, b->from.kind);
	} else if (point_takes_light(p)) {
		albedo = point_albedo(t, p, texturing);
		weight = v3_mul(weight, stage_light(transport, v3(albedo.x, albedo.y, albedo.z)));
		if (branch_survives(&weight, v))
			branch_scatter(b, p, d, weight, b->from.kind, at);
	}
}

/* Light that a path found, bounded if a surface scattered the path or it bounced twice. Rare samples of much light
 * would otherwise leave bright dots. */
static inline struct vec3 hit_bound(const struct shade_hit_arguments *a, const struct path *path, struct vec3 light)
{
	const float most = v3_most(light);

	return a->most > 0.0f && most > a->most && path->depth + (path->kind == PATH_DIFFUSE) > 1u ?
	               v3_scale(light, a->most / most) :
	               light;
}

/* Light that emissive surfaces send to a hit, minus the part of its own emission that the path's previous point already
 * sampled. */
static inline struct vec3 hit_emitters(const struct shade_hit_arguments *a, uint32_t item, const struct point *p,
                                       const struct texturing *texturing, struct vec3 d)
{
	const struct tables *t = &a->tables;
	const struct emitter_sample at = { a->frame, stage_seed(&a->paths[item], a->pixels, 0u), a->sample };
	const float strength = emitter_strength(a->transport, p->material, p->geometry->attributes),
		    density = a->paths[item].density;
	struct vec3 sum = v3(0.0f, 0.0f, 0.0f), seen;
	struct vec4 albedo;

	if (!a->emission.n_emitters)
		return sum;
	if (strength > 0.0f && density > 0.0f && !(p->geometry->flags & GEOMETRY_EXPANDED))
		sum = v3_scale(emitter_sends(t, p, a->transport),
		               emitter_weight(density, emitter_density(&a->emission, strength, a->hits[item].t * a->hits[item].t,
		                                                       v3_dot(point_plane_normal(p), d))) - 1.0f);
	seen = v3_load(a->visibility + (a->n_slots * a->n + item) * 3u);
	if (!(v3_most(seen) > 0.0f) || !point_takes_light(p) || a->paths[item].depth >= a->depth)
		return sum;
	albedo = point_albedo(t, p, texturing);
	seen = v3_mul(seen, stage_light(a->transport, v3(albedo.x, albedo.y, albedo.z)));
	return v3_add(sum, v3_mul(seen, emitter_light(t, &a->emission, a->transport, p, d, &at)));
}

/* shade_hit: writes what a path found to radiance[item], and the rays that continue from there. */
static inline void shade_hit_item(const struct shade_hit_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct hit hit = a->hits[item];
	GLOBAL float *out = a->radiance + item * 3u;
	struct vec3 d = v3_load(a->rays[item].d), seen[SCENE_MAX_LIGHTS], weight, own;
	struct branches b;
	struct point p;
	struct texturing texturing;
	struct split split;
	struct vec4 color;
	struct branch_samples at;
	int dimmed;

	b = branches_of_path(a->paths[item], a->next_rays, a->next_paths, item);
	a->counts[item] = 0u;
	weight = path_weight(&b.from);
	if (hit.instance == SCENE_NONE && b.from.kind == PATH_NEAR) {
		v3_store(out, v3_mul(weight, stage_light(a->transport, v3_load(a->shaded[b.from.target].direct))));
		return;
	}
	if (hit.instance == SCENE_NONE) {
		own = hit_nothing(t, a->transport, &a->sky[item], &a->rays[item], a->has_sky, a->background);
		v3_store(out, hit_bound(a, &b.from, v3_mul(weight, own)));
		return;
	}
	v3_store(out, v3(0.0f, 0.0f, 0.0f));
	p = point_from_hit(t, &hit, d);
	stage_seen(a->visibility, a->n_slots, a->n, item, seen);
	dimmed = stage_dimmed(a->visibility, a->n_slots, a->n, item);
	point_texture(t, &p, (const struct point_window *)0, &texturing);
	color = hit_color(t, &p, &texturing, a->transport, seen, dimmed);
	if (transparency_is_unseen(p.material) || transparency_is_hole(&p, color.w)) {
		branch_on(&b, &a->rays[item], hit.t, weight);
		a->counts[item] = b.count;
		return;
	}
	if (b.from.medium != SCENE_NONE)
		weight = v3_mul(weight, glass_absorb(&t->materials[b.from.medium], hit.t - a->rays[item].t_min));
	split = split_light(&p, d);
	if (p.material->surface.hidden & SCENE_NEAR_MIRROR) { /* in another mirror, it is seen with its own colour */
		split.base += split.mirrored;
		split.mirrored = 0.0f;
	}
	own = v3(color.x, color.y, color.z);
	if (stage_is_path(a->transport))
		own = v3_add(own, hit_emitters(a, item, &p, &texturing, d));
	if (p.material->blend && !(split.through > 0.0f) && !(p.material->surface.hidden & SCENE_SOLID)) {
		own = transparency_blend(p.material, color, v4(0.0f, 0.0f, 0.0f, 0.0f));
		branch_on(&b, &a->rays[item], hit.t, v3_mul(v3_scale(weight, split.base), transparency_of_blend(p.material, color)));
	}
	v3_store(out, hit_bound(a, &b.from, v3_mul(weight, v3_scale(own, split.base))));
	at.frame = a->frame;
	at.seed = stage_seed(&a->paths[item], a->pixels, 0u);
	at.index = a->sample;
	b.from.kind = b.from.kind == PATH_NEAR ? PATH_REFLECT : b.from.kind;
	if (b.from.depth < a->depth && stage_is_path(a->transport) && !b.count) {
		branch_one(t, a->transport, &b, &p, d, &split, &texturing, weight, &at);
	} else if (b.from.depth < a->depth && !stage_is_path(a->transport)) {
		branch_mirror(&b, &p, d, v3_scale(weight, split.mirrored), b.from.kind, &at);
		if (split.through > 0.0f)
			branch_through(&b, &p, d, &split,
			               v3_mul(v3_scale(weight, split.through), glass_tint(t, &p, &texturing)), b.from.kind);
	}
	a->counts[item] = b.count;
}

/*
 * credit: adds what the paths of a fragment found to its parts. The item of each fragment's first path sums them in
 * order.
 */
static inline void credit_item(const struct credit_arguments *a, uint32_t item)
{
	uint32_t target = a->paths[item].target;
	GLOBAL struct shaded *s = &a->shaded[target];

	if (item > 0u && a->paths[item - 1u].target == target)
		return;
	for (uint32_t i = item; i < a->n && a->paths[i].target == target; i++) {
		struct vec3 light = v3_load(a->radiance + i * 3u);

		if (a->paths[i].kind == PATH_DIFFUSE)
			credit_part(a->transport, s->direct, light);
		if (a->paths[i].kind != PATH_REFRACT)
			credit_part(a->transport, s->mirrored, light);
		credit_part(a->transport, s->beauty, light);
	}
}
