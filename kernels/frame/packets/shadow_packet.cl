/*
 * shadow_ray_packet: shadow_ray for SHADE_PACKET consecutive rays per work item, for CPUs: sixteen fragments of one
 * material at once (kernels/frame/pack/pack_ray.h). Fragments that packs do not support send their rays one by one;
 * data that a triangle's rays share is computed once.
 */
#include "kernels/frame/pack/pack_ray.h"

/* A bit for each of the fragments first .. end - 1, at most sixteen, that needs a ray to a light. */
static inline uint wanting(const struct shadow_ray_arguments *a, uint first, uint end, uint slot)
{
	uint lanes = 0;

	for (uint i = first; i < end; i++)
		if (a->shaded[i].flags & SHADED_THERE && a->shaded[i].flags & SHADED_WANTS(slot))
			lanes |= 1u << (i - first);
	return lanes;
}

static inline void send_lanes(const struct shadow_ray_arguments *a, const struct pack_list *list,
                              __global const struct scene_material *m, uint lanes, uint slot, __global struct ray *rays)
{
	struct pack_surface surface;
	struct pack_curve curve;
	struct vec3_16 back;
	struct pack p;

	p.material = m;
	p.view = &a->views[a->tables.geometries[list->instance[popcount((lanes & -lanes) - 1)]].view];
	pack_locate(&a->tables, a->windows, a->width, 1, list, lanes, &p);
	pack_surface(&a->tables, &p, &surface);
	pack_measure(&p, &surface);
	pack_curve_of(&a->tables, &p, &surface, &curve);
	back = v3_scale(v3_normalize(pack_view_direction(&p, 1)), (packf)(-1));
	pack_light_rays(&p, &surface, &curve, back, &pack_lights_of(&a->tables, m)[slot], lanes, list->item, rays);
}

/* Send rays first .. end - 1 of a slot, at most sixteen. */
static inline void send_sixteen(const struct shadow_ray_arguments *a, uint slot, uint first, uint end,
                                struct shadow_kept *kept)
{
	__global struct ray *rays = a->rays + slot * a->n + first;
	struct pack_list list;
	uint material, lanes = wanting(a, first, end, slot);

	pack_list(a->fragments, a->pixels, first, end, &list);
	for (uint lane = 0; lane < end - first; lane++)
		if (!(lanes >> lane & 1))
			stage_no_ray(&rays[lane]);
	while (lanes) {
		const uint bit = lanes & -lanes, lane = popcount(bit - 1), same = pack_same_kind(&a->tables, &list, lanes, &material);
		__global const struct scene_material *m = &a->tables.materials[material];

		if (same & bit && !pack_refuses_rays(m) && !pack_refuses_rays_light(&pack_lights_of(&a->tables, m)[slot])) {
			send_lanes(a, &list, m, same, slot, a->rays + slot * a->n);
			lanes &= ~same;
		} else {
			shadow_ray_item(a, slot * a->n + first + lane, 1, &kept[list.primitive[lane] % SHADE_TRIANGLES]);
			lanes &= ~bit;
		}
	}
}

KERNEL_OF(float16) void shadow_ray_packet(KERNEL_ARGUMENTS(shadow_ray))
{
	const uint first = (uint)get_global_id(0) * SHADE_PACKET, last = min(first + SHADE_PACKET, n_rays);
	const struct shadow_ray_arguments a = KERNEL_STRUCT(shadow_ray);
	struct shadow_kept kept[SHADE_TRIANGLES];

	for (uint i = 0; i < SHADE_TRIANGLES; i++)
		kept[i].instance = SCENE_NONE;
	for (uint at = first, end; at < last; at = end) {
		/* At most sixteen, of one slot. */
		end = min(min(at + PACK_SIZE, last), (at / n + 1) * n);
		send_sixteen(&a, at / n, at % n, at % n + (end - at), kept);
	}
}
