/* vertex_program: see kernels/gl/vertex_program.h. Frames without vertex programs do not compile it. */
#include "kernels/gl/vertex_program.h"

__kernel void vertex_program(KERNEL_ARGUMENTS(vertex_program)) KERNEL_ITEMS(vertex_program, n)
