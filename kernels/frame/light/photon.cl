/* Light traced from lights: see kernels/frame/light/photon.h. */
#include "kernels/frame/light/photon.h"

KERNEL_OF(float4) void photon(KERNEL_ARGUMENTS(photon)) KERNEL_ITEMS(photon, n)
