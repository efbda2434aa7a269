/* C twin of kernels/frame/vertex.cl. */
#include "kernels/gl/vertex.h"

KERNEL_TWIN(vertex, n)
KERNEL_TWIN(window, n)
