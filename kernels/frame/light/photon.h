/*
 * Light that travels from a light to a mirror or glass and beyond (H. W. Jensen, "Global Illumination using Photon
 * Maps", 1996). One work item follows one photon from surface to surface. Some fields of its path differ from those of
 * an eye path:
 *   target   the photon's number in its pass
 *   kind     the instance it was sent to; if it meets another first, it belongs to that one's photons or is stopped
 *   density  length of its path so far
 */
#pragma once

#include "kernels/frame/light/path.h"

/* The next ray from where a photon landed: mirrored, refracted, or none, in proportion to the light in each. */
static inline void photon_go_on(struct branches *b, const struct tables *t, const struct point *p,
                                const struct texturing *texturing, struct vec3 d, const struct split *s,
                                struct vec3 weight, uint32_t pass)
{
	const struct branch_samples at = { 0u, sample_hash(b->from.target ^ sample_hash(pass)), b->from.depth };
	const float u = sample_unit(sample_hash(at.seed + 0x9e3779b9u * (at.index + 1u)));

	if (u < s->mirrored)
		branch_mirror(b, p, d, weight, b->from.kind, &at);
	else if (u < s->mirrored + s->through)
		branch_through(b, p, d, s, v3_mul(weight, glass_tint(t, p, texturing)), b->from.kind);
}

static inline void photon_item(const struct photon_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	struct branches b = branches_of_path(a->paths[item], a->next_rays, a->next_paths, item);
	const struct hit hit = a->hits[item];
	const struct vec3 d = v3_load(a->rays[item].d);
	const float length = b.from.density + hit.t;
	GLOBAL struct photon *out = &a->photons[item];
	struct texturing texturing;
	struct vec3 weight;
	struct split split;
	struct point p;

	a->counts[item] = 0u;
	out->number = SCENE_NONE;
	if (hit.instance == SCENE_NONE || (b.from.depth == 0u && hit.instance != b.from.kind))
		return;
	p = point_from_hit(t, &hit, d);
	point_texture(t, &p, (const struct point_window *)0, &texturing);
	weight = path_weight(&b.from);
	if (b.from.medium != SCENE_NONE)
		weight = v3_mul(weight, glass_absorb(&t->materials[b.from.medium], hit.t));
	split = split_light(&p, d);
	if (b.from.depth > 0u && split.base > 0.0f && point_takes_light(&p)) {
		v3_store(out->position, point_position(&p));
		v3_store(out->direction, d);
		v3_store(out->weight, v3_scale(weight, split.base));
		out->length = length;
		out->material = p.geometry->material;
		out->number = b.from.target;
	}
	if (b.from.depth < a->depth)
		photon_go_on(&b, t, &p, &texturing, d, &split, weight, a->pass);
	if (b.count)
		b.paths[0].density = length;
	a->counts[item] = b.count;
}
