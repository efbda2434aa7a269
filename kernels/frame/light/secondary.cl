/* Paths beyond the first hit, and light through transmitting surfaces: see kernels/frame/light/path.h and shadow.h. */
#include "kernels/frame/light/path.h"

KERNEL_OF(float4) void shadow_walk(KERNEL_ARGUMENTS(shadow_walk)) KERNEL_ITEMS(shadow_walk, n)
__kernel void gather_paths(KERNEL_ARGUMENTS(gather_paths)) KERNEL_ITEMS(gather_paths, n)
__kernel void gather_hits(KERNEL_ARGUMENTS(gather_hits)) KERNEL_ITEMS(gather_hits, n)
KERNEL_OF(float4) void leave(KERNEL_ARGUMENTS(leave)) KERNEL_ITEMS(leave, n)
__kernel void sky_ray(KERNEL_ARGUMENTS(sky_ray)) KERNEL_ITEMS(sky_ray, n)
KERNEL_OF(float4) void want_lights(KERNEL_ARGUMENTS(want_lights)) KERNEL_ITEMS(want_lights, n)
KERNEL_OF(float4) void shade_hit(KERNEL_ARGUMENTS(shade_hit)) KERNEL_ITEMS(shade_hit, n)
KERNEL_OF(float4) void leave_ray(KERNEL_ARGUMENTS(leave_ray)) KERNEL_ITEMS(leave_ray, n)
KERNEL_OF(float4) void bounce_ray(KERNEL_ARGUMENTS(bounce_ray)) KERNEL_ITEMS(bounce_ray, n)
__kernel void credit(KERNEL_ARGUMENTS(credit)) KERNEL_ITEMS(credit, n)
