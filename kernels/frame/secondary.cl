/* Rays from fragments and hits: see kernels/frame/shadow.h and path.h. */
#include "kernels/frame/path.h"

__kernel void shadow_ray(KERNEL_ARGUMENTS(shadow_ray))
{
	const struct shadow_ray_arguments a = KERNEL_STRUCT(shadow_ray);
	struct shadow_kept kept;

	if (get_global_id(0) < n_rays)
		shadow_ray_item(&a, (uint32_t)get_global_id(0), 0, &kept);
}

__kernel void hit_ray(KERNEL_ARGUMENTS(hit_ray))
{
	const struct hit_ray_arguments a = KERNEL_STRUCT(hit_ray);

	if (get_global_id(0) < n_rays)
		hit_ray_item(&a, (uint32_t)get_global_id(0));
}

__kernel void ao_ray(KERNEL_ARGUMENTS(ao_ray))
{
	const struct ao_ray_arguments a = KERNEL_STRUCT(ao_ray);

	if (get_global_id(0) < n)
		ao_ray_item(&a, (uint32_t)get_global_id(0));
}

__kernel void shadow_sum(KERNEL_ARGUMENTS(shadow_sum))
{
	const struct shadow_sum_arguments a = KERNEL_STRUCT(shadow_sum);

	if (get_global_id(0) < n)
		shadow_sum_item(&a, (uint32_t)get_global_id(0));
}

__kernel void shadow_start(KERNEL_ARGUMENTS(shadow_start))
{
	const struct shadow_start_arguments a = KERNEL_STRUCT(shadow_start);

	if (get_global_id(0) < n)
		shadow_start_item(&a, (uint32_t)get_global_id(0));
}

__kernel void shadow_walk(KERNEL_ARGUMENTS(shadow_walk))
{
	const struct shadow_walk_arguments a = KERNEL_STRUCT(shadow_walk);

	if (get_global_id(0) < n)
		shadow_walk_item(&a, (uint32_t)get_global_id(0));
}

__kernel void gather_paths(KERNEL_ARGUMENTS(gather_paths))
{
	const struct gather_paths_arguments a = KERNEL_STRUCT(gather_paths);

	if (get_global_id(0) < n)
		gather_paths_item(&a, (uint32_t)get_global_id(0));
}

__kernel void leave(KERNEL_ARGUMENTS(leave))
{
	const struct leave_arguments a = KERNEL_STRUCT(leave);

	if (get_global_id(0) < n)
		leave_item(&a, (uint32_t)get_global_id(0));
}

__kernel void sky_ray(KERNEL_ARGUMENTS(sky_ray))
{
	const struct sky_ray_arguments a = KERNEL_STRUCT(sky_ray);

	if (get_global_id(0) < n)
		sky_ray_item(&a, (uint32_t)get_global_id(0));
}

__kernel void want_lights(KERNEL_ARGUMENTS(want_lights))
{
	const struct want_lights_arguments a = KERNEL_STRUCT(want_lights);

	if (get_global_id(0) < n)
		want_lights_item(&a, (uint32_t)get_global_id(0));
}

__kernel void shade_hit(KERNEL_ARGUMENTS(shade_hit))
{
	const struct shade_hit_arguments a = KERNEL_STRUCT(shade_hit);

	if (get_global_id(0) < n)
		shade_hit_item(&a, (uint32_t)get_global_id(0));
}

__kernel void credit(KERNEL_ARGUMENTS(credit))
{
	const struct credit_arguments a = KERNEL_STRUCT(credit);

	if (get_global_id(0) < n)
		credit_item(&a, (uint32_t)get_global_id(0));
}

__kernel void ao_shade(KERNEL_ARGUMENTS(ao_shade))
{
	const struct ao_shade_arguments a = KERNEL_STRUCT(ao_shade);

	if (get_global_id(0) < n)
		ao_shade_item(&a, (uint32_t)get_global_id(0));
}
