/*
 * sRGB's transfer function (IEC 61966-2-1) both ways: GL's numbers are display-referred, light is not. By nothing but
 * what is the same on every device.
 */
#pragma once

#include "kernels/common.h"

#include "kernels/encode_lanes.h"
