/* Rays from fragments and hits: see kernels/frame/shadow.h and path.h. */
#include "kernels/frame/path.h"

KERNEL_OF(float4) void shadow_ray(KERNEL_ARGUMENTS(shadow_ray))
{
	const struct shadow_ray_arguments a = KERNEL_STRUCT(shadow_ray);
	struct shadow_kept kept;

	if (get_global_id(0) < n_rays)
		shadow_ray_item(&a, (uint32_t)get_global_id(0), 0, &kept);
}

KERNEL_OF(float4) void hit_ray(KERNEL_ARGUMENTS(hit_ray)) KERNEL_ITEMS(hit_ray, n_rays)
KERNEL_OF(float4) void ao_ray(KERNEL_ARGUMENTS(ao_ray)) KERNEL_ITEMS(ao_ray, n)
__kernel void shadow_sum(KERNEL_ARGUMENTS(shadow_sum)) KERNEL_ITEMS(shadow_sum, n)
__kernel void shadow_start(KERNEL_ARGUMENTS(shadow_start)) KERNEL_ITEMS(shadow_start, n)
KERNEL_OF(float4) void shadow_walk(KERNEL_ARGUMENTS(shadow_walk)) KERNEL_ITEMS(shadow_walk, n)
__kernel void gather_paths(KERNEL_ARGUMENTS(gather_paths)) KERNEL_ITEMS(gather_paths, n)
KERNEL_OF(float4) void leave(KERNEL_ARGUMENTS(leave)) KERNEL_ITEMS(leave, n)
__kernel void sky_ray(KERNEL_ARGUMENTS(sky_ray)) KERNEL_ITEMS(sky_ray, n)
KERNEL_OF(float4) void want_lights(KERNEL_ARGUMENTS(want_lights)) KERNEL_ITEMS(want_lights, n)
KERNEL_OF(float4) void shade_hit(KERNEL_ARGUMENTS(shade_hit)) KERNEL_ITEMS(shade_hit, n)
__kernel void credit(KERNEL_ARGUMENTS(credit)) KERNEL_ITEMS(credit, n)
__kernel void ao_shade(KERNEL_ARGUMENTS(ao_shade)) KERNEL_ITEMS(ao_shade, n)
