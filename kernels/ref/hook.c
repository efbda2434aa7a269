/* C twins of kernels/frame/hook.cl, where no hook is there. */
#include "kernels/frame/hook.h"

KERNEL_TWIN(hook_ray, n)
KERNEL_TWIN(hook_see, n)
KERNEL_TWIN(hook_store, n)
KERNEL_TWIN(hook_shade, n)
KERNEL_TWIN(hook_ways, n)
KERNEL_TWIN(hook_hit, n)
