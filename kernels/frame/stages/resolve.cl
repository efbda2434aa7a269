/* gather, clear, resolve, merge_samples: see kernels/gl/stages.h, kernels/gl/pixel.h. */
#include "kernels/gl/stages.h"

__kernel void gather(KERNEL_ARGUMENTS(gather)) KERNEL_ITEMS(gather, n)
__kernel void clear(KERNEL_ARGUMENTS(clear)) KERNEL_ITEMS(clear, n)
KERNEL_OF(float4) void resolve(KERNEL_ARGUMENTS(resolve)) KERNEL_ITEMS(resolve, n)
__kernel void merge_samples(KERNEL_ARGUMENTS(merge_samples)) KERNEL_ITEMS(merge_samples, n)
