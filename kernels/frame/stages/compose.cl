/* compose, add_pass: see kernels/frame/stages/compose.h. */
#include "kernels/frame/stages/compose.h"

__kernel void compose(KERNEL_ARGUMENTS(compose)) KERNEL_ITEMS(compose, n)
__kernel void add_pass(KERNEL_ARGUMENTS(add_pass)) KERNEL_ITEMS(add_pass, n)
