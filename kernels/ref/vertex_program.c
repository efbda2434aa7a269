/* C twin of kernels/frame/stages/vertex_program.cl. */
#include "kernels/gl/vertex_program.h"

KERNEL_TWIN(vertex_program, n)
