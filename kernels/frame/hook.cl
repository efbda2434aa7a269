/* Kernels that call a user's functions: see kernels/frame/hook.h. The user's text stands behind this one. */
#include "kernels/frame/hook.h"

KERNEL_OF(float4) void hook_ray(KERNEL_ARGUMENTS(hook_ray)) KERNEL_ITEMS(hook_ray, n)
__kernel void hook_see(KERNEL_ARGUMENTS(hook_see)) KERNEL_ITEMS(hook_see, n)
__kernel void hook_store(KERNEL_ARGUMENTS(hook_store)) KERNEL_ITEMS(hook_store, n)
KERNEL_OF(float4) void hook_shade(KERNEL_ARGUMENTS(hook_shade)) KERNEL_ITEMS(hook_shade, n)
KERNEL_OF(float4) void hook_ways(KERNEL_ARGUMENTS(hook_ways)) KERNEL_ITEMS(hook_ways, n)
KERNEL_OF(float4) void hook_hit(KERNEL_ARGUMENTS(hook_hit)) KERNEL_ITEMS(hook_hit, n)
