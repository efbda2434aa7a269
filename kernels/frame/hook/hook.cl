/* Kernels that call a user's functions: see kernels/frame/hook/hook.h and hook_object.h. The user's text is appended to
 * this file. */
#include "kernels/frame/hook/hook.h"
#include "kernels/frame/hook/hook_object.h"

KERNEL_OF(float4) void hook_ray(KERNEL_ARGUMENTS(hook_ray)) KERNEL_ITEMS(hook_ray, n)
__kernel void hook_see(KERNEL_ARGUMENTS(hook_see)) KERNEL_ITEMS(hook_see, n)
__kernel void hook_store(KERNEL_ARGUMENTS(hook_store)) KERNEL_ITEMS(hook_store, n)
KERNEL_OF(float4) void hook_shade(KERNEL_ARGUMENTS(hook_shade)) KERNEL_ITEMS(hook_shade, n)
KERNEL_OF(float4) void hook_ways(KERNEL_ARGUMENTS(hook_ways)) KERNEL_ITEMS(hook_ways, n)
KERNEL_OF(float4) void hook_hit(KERNEL_ARGUMENTS(hook_hit)) KERNEL_ITEMS(hook_hit, n)
__kernel void hook_walk(KERNEL_ARGUMENTS(hook_walk)) KERNEL_ITEMS(hook_walk, n)
KERNEL_OF(float4) void hook_light(KERNEL_ARGUMENTS(hook_light)) KERNEL_ITEMS(hook_light, n_rays)
KERNEL_OF(float4) void hook_light_hit(KERNEL_ARGUMENTS(hook_light_hit)) KERNEL_ITEMS(hook_light_hit, n_rays)
__kernel void hook_bounds(KERNEL_ARGUMENTS(hook_bounds)) KERNEL_ITEMS(hook_bounds, n)
KERNEL_OF(float4) void hook_intersect(KERNEL_ARGUMENTS(hook_intersect)) KERNEL_ITEMS(hook_intersect, n)
KERNEL_OF(float4) void hook_occlude(KERNEL_ARGUMENTS(hook_occlude)) KERNEL_ITEMS(hook_occlude, n)
