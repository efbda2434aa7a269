/* C twin of kernels/frame/photon.cl. */
#include "kernels/frame/photon.h"

KERNEL_TWIN(photon, n)
