/* C twins of kernels/frame/resolve.cl. */
#include "kernels/gl/stages.h"

KERNEL_TWIN(clear, n)
KERNEL_TWIN(resolve, n)
KERNEL_TWIN(merge_samples, n)
