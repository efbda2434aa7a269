/* C twins of kernels/frame/hook/hook.cl, without hooks. */
#include "kernels/frame/hook/hook.h"
#include "kernels/frame/hook/hook_object.h"

KERNEL_TWIN(hook_ray, n)
KERNEL_TWIN(hook_see, n)
KERNEL_TWIN(hook_store, n)
KERNEL_TWIN(hook_shade, n)
KERNEL_TWIN(hook_ways, n)
KERNEL_TWIN(hook_hit, n)
KERNEL_TWIN(hook_walk, n)
KERNEL_TWIN(hook_light, n_rays)
KERNEL_TWIN(hook_light_hit, n_rays)
KERNEL_TWIN(hook_bounds, n)
KERNEL_TWIN(hook_intersect, n)
KERNEL_TWIN(hook_occlude, n)
