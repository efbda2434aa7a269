/* vertex: see vertex_item. window: see window_item. */
#include "kernels/gl/vertex.h"

KERNEL_OF(float4) void vertex(KERNEL_ARGUMENTS(vertex)) KERNEL_ITEMS(vertex, n)
__kernel void window(KERNEL_ARGUMENTS(window)) KERNEL_ITEMS(window, n)
