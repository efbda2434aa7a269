/*
 * shadow_ray_packet: shadow_ray with SHADE_PACKET consecutive rays a work item, for CPUs: as in shade_packet.cl, what rays from a
 * triangle share is found once.
 */
#include "kernels/frame/secondary.h"

__kernel void shadow_ray_packet(TABLES_ARGUMENTS, __global const struct view *views,
                                __global const struct window_vertex *windows, __global const struct fragment *fragments,
                                __global const uint32_t *pixels, uint32_t width, __global const struct shaded *shaded,
                                uint32_t sample, uint32_t n, uint32_t n_rays, __global struct ray *rays)
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	struct tables t = TABLES_NAMED;
	struct stage_kept_plane kept[SHADE_TRIANGLES];

	for (uint32_t i = 0u; i < SHADE_TRIANGLES; i++)
		kept[i].instance = SCENE_NONE;
	for (uint32_t i = first; i < first + SHADE_PACKET && i < n_rays; i++)
		shadow_ray_item(&t, views, windows, fragments, pixels, width, shaded, sample, n, rays, i, 1,
		                &kept[fragments[i % n].primitive % SHADE_TRIANGLES]);
}
