/* vertex: see vertex_item. */
#include "kernels/gl/vertex.h"

KERNEL_OF(float4) void vertex(KERNEL_ARGUMENTS(vertex)) KERNEL_ITEMS(vertex, n)
