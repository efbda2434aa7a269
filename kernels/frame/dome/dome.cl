/* Light from the dome: see kernels/frame/dome/dome.h. Compiled only if rules ask for it. */
#include "kernels/frame/dome/dome.h"

KERNEL_OF(float4) void dome_find(KERNEL_ARGUMENTS(dome_find)) KERNEL_ITEMS(dome_find, n)
__kernel void dome_sum(KERNEL_ARGUMENTS(dome_sum)) KERNEL_ITEMS(dome_sum, n)
KERNEL_OF(float4) void dome_light(KERNEL_ARGUMENTS(dome_light)) KERNEL_ITEMS(dome_light, n)
