/* C twin of kernels/frame/light/photon.cl. */
#include "kernels/frame/light/photon.h"

KERNEL_TWIN(photon, n)
