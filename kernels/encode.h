/*
 * sRGB's transfer function (IEC 61966-2-1) in both directions, since GL's numbers are display-referred and light is
 * linear. It uses only operations that give the same result on every device.
 */
#pragma once

#include "kernels/common.h"

#include "kernels/encode_lanes.h"
