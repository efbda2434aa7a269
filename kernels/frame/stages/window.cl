/* window: see window_item. */
#include "kernels/gl/vertex.h"

__kernel void window(KERNEL_ARGUMENTS(window)) KERNEL_ITEMS(window, n)
