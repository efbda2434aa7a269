/*
 * Paths, SHADE_PACKET items of their lists per work item, for CPUs: sixteen points of one material at once
 * (kernels/frame/pack/pack_hit.h). Points that packs do not support are processed one by one.
 */
#include "kernels/frame/pack/pack_hit.h"

/* --- Which ones -------------------------------------------------------------------------------------------------- */

/* Find the hits of a work item. */
static inline void find_hits(const struct shade_arguments *s, __global const struct hit *hits, uint first, uint n,
                             struct pack_left *left)
{
	uint last = SCENE_NONE;
	int known = 0;

	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, n - first); i++) {
		const uint instance = hits[first + i].instance;
		__global const struct geometry *g = &s->tables.geometries[instance];

		left->all |= (ulong)1 << i;
		left->material[i] = SCENE_NONE;
		if (instance == SCENE_NONE)
			continue;
		if (g->material != last)
			known = stage_is_path(s->transport) ? pack_knows_bounces(s, &s->tables.materials[g->material]) :
			                                      pack_knows_paths(s, &s->tables.materials[g->material]);
		last = left->material[i] = g->material;
		if (known && pack_knows_geometry(g))
			left->packed |= (ulong)1 << i;
	}
}

/* Find the fragments of a work item that light leaves; the others have no paths. */
static inline void find_leaving(const struct leave_arguments *a, const struct shade_arguments *s, uint first,
                                struct pack_left *left)
{
	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, a->n - first); i++) {
		__global const struct geometry *g = &a->tables.geometries[a->fragments[first + i].instance];
		__global const struct scene_material *m = &a->tables.materials[g->material];

		a->counts[first + i] = 0;
		left->material[i] = g->material;
		if (!(a->shaded[first + i].flags & SHADED_THERE) ||
		    (a->transport < TRANSPORT_DIFFUSE && !(m->surface.reflect > 0.0f || m->surface.transmit > 0.0f)))
			continue;
		left->all |= (ulong)1 << i;
		if (pack_knows_leaving(s, m) && pack_knows_geometry(g))
			left->packed |= (ulong)1 << i;
	}
}

/* --- Rays to lights ---------------------------------------------------------------------------------------------- */

static inline void send_alone(const struct hit_ray_arguments *a, uint item)
{
	const struct want_lights_arguments w = {
		.tables = a->tables, .hits = a->hits, .rays = a->rays, .transport = a->transport, .n = a->n, .wanted = a->wanted,
	};

	want_lights_item(&w, item);
	for (uint at = item; at < a->n_rays; at += a->n)
		hit_ray_item(a, at);
}

/* A bit for each light that lights a hit. */
static inline packu lights_at(const struct hit_ray_arguments *a, const struct pack_points *q)
{
	const struct shade_arguments s = { .tables = a->tables };
	struct lit_16 here;

	if (stage_is_path(a->transport))
		return pack_radiant_lights(&a->tables, &q->p, &q->surface);
	if (!q->p.material->surface.relit)
		return pack_lights(&a->tables, &q->p);
	pack_lit_here(&s, &q->list, &q->p, &q->surface, q->lanes, &here);
	return here.lights;
}

/* @return 0: one of the lights has a size */
static inline int send_lanes(const struct hit_ray_arguments *a, struct pack_points *q,
                             __global const struct scene_material *m)
{
	const uint n_slots = a->n_rays / a->n, n_lights = m->surface.relit ? m->surface.light_count : m->light_count;
	__global const struct scene_light *light = pack_lights_of(&a->tables, m);
	struct pack_curve curve;
	packu lights;

	for (uint slot = 0; slot < min(n_slots, n_lights); slot++)
		if (light[slot].radius > 0.0f)
			return 0;
	pack_place_hits(&a->tables, a->rays, m, q);
	lights = lights_at(a, q) & 255;
	pack_curve_of(&a->tables, &q->p, &q->surface, &curve);
	for (uint slot = 0; slot < n_slots; slot++) {
		__global struct ray *rays = a->out + slot * a->n;
		const uint wanted = q->lanes & pack_bits((lights >> slot & 1) != 0);

		if (wanted)
			pack_light_rays(&q->p, &q->surface, &curve, q->back, &light[slot], wanted, q->list.item, rays);
		for (uint left = q->lanes & ~wanted; left; left &= left - 1)
			stage_no_ray(&rays[q->list.item[popcount((left & -left) - 1)]]);
	}
	return 1;
}

KERNEL_OF(float16) void hit_ray_packet(KERNEL_ARGUMENTS(hit_ray))
{
	const uint first = (uint)get_global_id(0) * SHADE_PACKET;
	const struct hit_ray_arguments a = KERNEL_STRUCT(hit_ray);
	const struct shade_arguments s = { .tables = a.tables, .transport = transport };
	struct pack_left left;
	struct pack_points q;
	uint item[PACK_SIZE];

	if (first >= n)
		return;
	find_hits(&s, hits, first, n, &left);
	while (left.all) {
		q.lanes = pack_next(&left, item);
		for (uint lane = 0; lane < PACK_SIZE && q.lanes; lane++)
			pack_take_hit(hits, item[lane], lane, &q.list);
		if (q.lanes && send_lanes(&a, &q, &a.tables.materials[left.material[item[0] - first]]))
			continue;
		send_alone(&a, item[0]);
		for (uint alone = q.lanes & ~1u; alone; alone &= alone - 1)
			send_alone(&a, item[popcount((alone & -alone) - 1)]);
	}
}

/* --- Hits -------------------------------------------------------------------------------------------------------- */

/* Loads of paths. */
struct way {
	struct vec3_16 weight;
	packu kind;
	struct pack_branches branches;
};

/* Load the paths of q's lanes. */
WIDE_VECTORS static inline void load_paths(const struct shade_hit_arguments *a, const struct pack_points *q,
                                           struct way *way)
{
	const packu place = vload16(0, q->list.item) * 8;
	packf row[4], last[4];

	pack_gather_from((__global const float *)a->paths, place, row);
	pack_gather_from((__global const float *)a->paths, place + 3, last);
	way->weight = v3_16(row[0], row[1], row[2]);
	/* PATH_NEAR paths that hit something */
	way->kind = select(as_uint16(last[1]), (packu)(PATH_REFLECT), as_uint16(last[1]) == PATH_NEAR);
	way->branches.rays = a->next_rays;
	way->branches.paths = a->next_paths;
	way->branches.slots = PATHS_PER_HIT;
	way->branches.target = as_uint16(row[3]);
	way->branches.depth = as_uint16(last[2]);
	way->branches.medium = as_uint16(last[3]);
	vstore16((packu)(0), 0, way->branches.count);
}

/* Attenuate by the bodies that paths travelled through; clear bodies absorb nothing. */
static inline void absorb(const struct tables *t, const struct pack_points *q, struct way *way)
{
	for (uint left = q->lanes & pack_bits(way->branches.medium != SCENE_NONE); left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		__global const struct scene_material *m = &t->materials[LANE(way->branches.medium, uint, lane)];
		struct vec3 rest;

		if (m->surface.absorb[0] == 0.0f && m->surface.absorb[1] == 0.0f && m->surface.absorb[2] == 0.0f)
			continue;
		rest = glass_absorb(m, LANE(q->t, const float, lane) - LANE(q->t_min, const float, lane));
		LANE(way->weight.x, float, lane) *= rest.x;
		LANE(way->weight.y, float, lane) *= rest.y;
		LANE(way->weight.z, float, lane) *= rest.z;
	}
}

/* hit_color for all lanes. lit: receives the colours as lit at the vertices */
static inline struct vec3_16 color_of(const struct shade_arguments *s, const struct pack_points *q,
                                       const struct pack_texturing *texturing, struct pack_kept *kept,
                                       struct vec4_16 *lit)
{
	struct vec4_16 secondary, color, relit;
	struct pack_corners_lit again;
	uint dimmed = 0;
	packu lights;

	for (uint left = s->n_slots && !q->p.material->surface.relit ? q->lanes : 0; left; left &= left - 1)
		if (stage_dimmed(s->visibility, s->n_slots, s->n, q->list.item[popcount((left & -left) - 1)]))
			dimmed |= left & -left;
	pack_lit_from_vertices(&s->tables, &q->p, lit, &secondary);
	color = pack_finish(&s->tables, &q->p, texturing, lit, &secondary);
	if (dimmed) {
		pack_light_again(s, &q->list, &q->p, dimmed, kept, &again);
		relit = pack_between_again(&q->p, again.color);
		secondary = pack_between_again(&q->p, again.secondary);
		relit = pack_finish(&s->tables, &q->p, texturing, &relit, &secondary);
		color = v4_choose(pack_mask(dimmed), relit, color);
	}
	color = pack_direct(s, &q->list, &q->p, q->lanes, texturing, &color, &lights);
	return v3_16(color.x, color.y, color.z);
}

static inline void store_hits(const struct shade_hit_arguments *a, const struct pack_points *q,
                              const struct vec3_16 *out, const struct way *way)
{
	for (uint left = q->lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1), item = q->list.item[lane];

		v3_store(a->radiance + item * 3,
		         v3(LANE(out->x, const float, lane), LANE(out->y, const float, lane), LANE(out->z, const float, lane)));
		a->counts[item] = way->branches.count[lane];
	}
}

static inline void shade_hits(const struct shade_hit_arguments *a, const struct shade_arguments *s,
                              struct pack_points *q, __global const struct scene_material *m, struct pack_kept *kept)
{
	struct pack_texturing texturing;
	struct pack_split split;
	struct vec4_16 lit;
	struct vec3_16 out;
	struct way way;
	uint on;

	pack_place_hits(&a->tables, a->rays, m, q);
	load_paths(a, q, &way);
	pack_texture_hits(&a->tables, &q->list, &q->p, q->lanes, &texturing);
	out = color_of(s, q, &texturing, kept, &lit);
	absorb(&a->tables, q, &way);
	pack_split_light(&a->tables, q, q->d, &split);
	if (m->surface.hidden & SCENE_NEAR_MIRROR) {
		split.base += split.mirrored;
		split.mirrored = 0;
	}
	out = v3_mul(way.weight, v3_scale(out, split.base));
	on = q->lanes & pack_bits(way.branches.depth < a->depth);
	if (on && (m->surface.reflect > 0.0f || m->surface.transmit > 0.0f))
		pack_branch_mirror(&a->tables, q, on, q->d, &split, v3_scale(way.weight, split.mirrored), way.kind, &way.branches);
	on &= pack_bits(split.through > 0.0f);
	if (on)
		pack_branch_through(
			&a->tables, q, on, q->d, &split,
			v3_mul(v3_scale(way.weight, split.through), pack_tint(&a->tables, q, &texturing, &lit)),
			way.kind, &way.branches);
	store_hits(a, q, &out, &way);
}

/* hit_bound for all lanes. kind: the paths' own */
static inline struct vec3_16 bound(const struct shade_hit_arguments *a, const struct way *way, packu kind,
                                    struct vec3_16 light)
{
	const packf most = v3_most(light);
	const packi bounced = (way->branches.depth > 1) | ((way->branches.depth == 1) & (kind == PATH_DIFFUSE));

	return a->most > 0.0f ? v3_choose(bounced & (most > a->most), v3_scale(light, a->most / most), light) : light;
}

/* The same for light transport. */
static inline void shade_bounces(const struct shade_hit_arguments *a, const struct shade_arguments *s,
                                 struct pack_points *q, __global const struct scene_material *m)
{
	struct pack_texturing texturing;
	struct vec4_16 lit, secondary;
	struct vec3_16 albedo = v3_16(0, 0, 0);
	packu pixel = 0, kind = 0;
	struct vec3_16 out;
	struct way way;
	uint on;

	pack_place_hits(&a->tables, a->rays, m, q);
	load_paths(a, q, &way);
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		LANE(pixel, uint, lane) = a->pixels[LANE(way.branches.target, uint, lane)];
		LANE(kind, uint, lane) = a->paths[q->list.item[lane]].kind;
	}
	pack_texture_hits(&a->tables, &q->list, &q->p, q->lanes, &texturing);
	pack_lit_from_vertices(&a->tables, &q->p, &lit, &secondary);
	out = pack_radiance(s, &q->list, &q->p, &q->surface, q->lanes, &texturing, &lit, &secondary, &albedo);
	absorb(&a->tables, q, &way);
	out = bound(a, &way, kind, v3_mul(way.weight, out));
	on = pack_takes_light(m) ? q->lanes & pack_bits(way.branches.depth < a->depth) : 0;
	if (on)
		pack_branch_scatter(a, q, on, sample_hash(sample_hash(pixel) + way.branches.depth * 4 + kind), albedo,
		                    way.weight, way.kind, &way.branches);
	store_hits(a, q, &out, &way);
}

KERNEL_OF(float16) void shade_hit_packet(KERNEL_ARGUMENTS(shade_hit))
{
	const uint first = (uint)get_global_id(0) * SHADE_PACKET;
	const struct shade_hit_arguments a = KERNEL_STRUCT(shade_hit);
	const struct shade_arguments s = {
		.tables = a.tables, .visibility = visibility, .n_slots = n_slots, .transport = transport, .n = n,
	};
	struct pack_left left;
	struct pack_kept kept;
	struct pack_points q;
	uint item[PACK_SIZE];

	if (first >= n)
		return;
	for (uint i = 0; i < SHADE_TRIANGLES; i++)
		kept.lit[i].instance = SCENE_NONE;
	find_hits(&s, hits, first, n, &left);
	if (stage_is_path(transport) && a.emission.n_emitters)
		left.packed = 0;
	while (left.all) {
		q.lanes = pack_next(&left, item);
		for (uint lane = 0; lane < PACK_SIZE && q.lanes; lane++)
			pack_take_hit(hits, item[lane], lane, &q.list);
		if (q.lanes && stage_is_path(transport))
			shade_bounces(&a, &s, &q, &a.tables.materials[left.material[item[0] - first]]);
		else if (q.lanes)
			shade_hits(&a, &s, &q, &a.tables.materials[left.material[item[0] - first]], &kept);
		else
			shade_hit_item(&a, item[0]);
	}
}

/* --- Fragments --------------------------------------------------------------------------------------------------- */

static inline void leave_lanes(const struct leave_arguments *a, struct pack_points *q,
                               __global const struct scene_material *m)
{
	struct vec4_16 lit, secondary;
	struct pack_texturing texturing;
	struct pack_branches branches;
	struct pack_split split;
	struct vec3_16 weight;
	uint through, kind;

	q->p.material = m;
	q->p.view = &a->views[a->tables.geometries[q->list.instance[0]].view];
	pack_locate(&a->tables, a->windows, a->width, 1, &q->list, q->lanes, &q->p);
	pack_surface(&a->tables, &q->p, &q->surface);
	pack_measure(&q->p, &q->surface);
	q->d = v3_normalize(pack_view_direction(&q->p, 1));
	q->back = v3_scale(v3_normalize(q->d), (packf)(-1));
	pack_split_light(&a->tables, q, q->d, &split);
	branches.rays = a->next_rays;
	branches.paths = a->next_paths;
	branches.slots = PATHS_PER_FRAGMENT;
	branches.target = vload16(0, q->list.item);
	branches.depth = 0;
	branches.medium = SCENE_NONE;
	vstore16((packu)(0), 0, branches.count);
	for (uint left = q->lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		__global struct shaded *s = &a->shaded[q->list.item[lane]];
		const struct vec3 direct = v3_load(s->direct), mirrored = v3_scale(direct, 1.0f - LANE(split.mirrored, float, lane));

		v3_store(s->mirrored, mirrored);
		v3_store(s->beauty, v3_sub(mirrored, v3_scale(direct, LANE(split.through, float, lane))));
	}
	weight = v3_16(split.mirrored, split.mirrored, split.mirrored);
	kind = m->surface.hidden & SCENE_NEAR_MIRROR ? PATH_NEAR : PATH_REFLECT;
	if (m->surface.roughness > 0.0f)
		pack_branch_rough(a, q, q->d, &split, weight, (packu)(kind), &branches);
	else
		pack_branch_mirror(&a->tables, q, q->lanes, q->d, &split, weight, (packu)(kind), &branches);
	through = q->lanes & pack_bits(split.through > 0.0f);
	if (through) {
		pack_texture_hits(&a->tables, &q->list, &q->p, q->lanes, &texturing);
		pack_lit_from_vertices(&a->tables, &q->p, &lit, &secondary);
		weight = v3_scale(pack_tint(&a->tables, q, &texturing, &lit), split.through);
		pack_branch_through(&a->tables, q, through, q->d, &split, weight, (packu)(PATH_REFRACT), &branches);
	}
	for (uint left = q->lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		a->counts[q->list.item[lane]] = branches.count[lane];
	}
}

KERNEL_OF(float16) void leave_packet(KERNEL_ARGUMENTS(leave))
{
	const uint first = (uint)get_global_id(0) * SHADE_PACKET;
	const struct leave_arguments a = KERNEL_STRUCT(leave);
	const struct shade_arguments s = { .tables = a.tables, .transport = transport };
	struct pack_left left;
	struct pack_points q;
	uint item[PACK_SIZE];

	if (first >= n)
		return;
	find_leaving(&a, &s, first, &left);
	while (left.all) {
		q.lanes = pack_next(&left, item);
		for (uint lane = 0; lane < PACK_SIZE && q.lanes; lane++)
			pack_take(fragments, pixels, item[lane], lane, &q.list);
		if (q.lanes)
			leave_lanes(&a, &q, &a.tables.materials[left.material[item[0] - first]]);
		else
			leave_item(&a, item[0]);
	}
}
