/* Rays from fragments and hits to lights and to the surroundings: see kernels/frame/light/shadow.h. Plain frames need
 * only these, so paths are compiled separately. */
#include "kernels/frame/light/shadow.h"

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
__kernel void ao_shade(KERNEL_ARGUMENTS(ao_shade)) KERNEL_ITEMS(ao_shade, n)
