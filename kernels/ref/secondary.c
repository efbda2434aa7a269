/* C twins of kernels/frame/light/secondary.cl, secondary_packet.cl and shadow_packet.cl. */
#include "kernels/frame/light/path.h"

void shadow_ray_c(const struct shadow_ray_arguments *a, size_t first, size_t last)
{
	struct shadow_kept kept;

	for (size_t i = first; i < last && i < a->n_rays; i++)
		shadow_ray_item(a, (uint32_t)i, 0, &kept);
}

/* Each ray is processed alone, so that caching between neighbours must not be visible. */
void shadow_ray_packet_c(const struct shadow_ray_arguments *a, size_t first, size_t last)
{
	shadow_ray_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}

KERNEL_TWIN(hit_ray, n_rays)
KERNEL_TWIN(ao_ray, n)
KERNEL_TWIN(shadow_sum, n)
KERNEL_TWIN(shadow_start, n)
KERNEL_TWIN(shadow_walk, n)
KERNEL_TWIN(gather_paths, n)
KERNEL_TWIN(gather_hits, n)
KERNEL_TWIN(leave, n)
KERNEL_TWIN(sky_ray, n)
KERNEL_TWIN(want_lights, n)
KERNEL_TWIN(shade_hit, n)
KERNEL_TWIN(leave_ray, n)
KERNEL_TWIN(bounce_ray, n)
KERNEL_TWIN(credit, n)
KERNEL_TWIN(ao_shade, n)

/* This kernel handles all lights of a hit at once. */
void hit_ray_packet_c(const struct hit_ray_arguments *a, size_t first, size_t last)
{
	const struct want_lights_arguments w = { .tables = a->tables,
		                                 .hits = a->hits,
		                                 .rays = a->rays,
		                                 .transport = a->transport,
		                                 .n = a->n,
		                                 .wanted = a->wanted };

	for (size_t i = first * SHADE_PACKET; i < last * SHADE_PACKET && i < a->n; i++) {
		want_lights_item(&w, (uint32_t)i);
		for (size_t at = i; at < a->n_rays; at += a->n)
			hit_ray_item(a, (uint32_t)at);
	}
}

void leave_packet_c(const struct leave_arguments *a, size_t first, size_t last)
{
	leave_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}

void shade_hit_packet_c(const struct shade_hit_arguments *a, size_t first, size_t last)
{
	shade_hit_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}
