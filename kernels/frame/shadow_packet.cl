/*
 * shadow_ray_packet: shadow_ray with SHADE_PACKET consecutive rays a work item, for CPUs: as in shade_packet.cl, what rays from a
 * triangle share is found once.
 */
#include "kernels/frame/shadow.h"

KERNEL_OF(float4) void shadow_ray_packet(KERNEL_ARGUMENTS(shadow_ray))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shadow_ray_arguments a = KERNEL_STRUCT(shadow_ray);
	struct shadow_kept kept[SHADE_TRIANGLES];

	for (uint32_t i = 0u; i < SHADE_TRIANGLES; i++)
		kept[i].instance = SCENE_NONE;
	for (uint32_t i = first; i < first + SHADE_PACKET && i < n_rays; i++)
		shadow_ray_item(&a, i, 1, &kept[fragments[i % n].primitive % SHADE_TRIANGLES]);
}
