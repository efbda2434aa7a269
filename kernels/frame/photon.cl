/* Light traced from lights: see kernels/frame/photon.h. */
#include "kernels/frame/photon.h"

KERNEL_OF(float4) void photon(KERNEL_ARGUMENTS(photon)) KERNEL_ITEMS(photon, n)
