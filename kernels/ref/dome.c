/* C twins of kernels/frame/dome.cl. */
#include "kernels/frame/dome.h"

KERNEL_TWIN(dome_find, n)
KERNEL_TWIN(dome_ray, n)
KERNEL_TWIN(dome_sum, n)
KERNEL_TWIN(dome_light, n)
