/* vertex: see vertex_item. */
#include "kernels/gl/vertex.h"

__kernel void vertex(KERNEL_ARGUMENTS(vertex)) KERNEL_ITEMS(vertex, n)
