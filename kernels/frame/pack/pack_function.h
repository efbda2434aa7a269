/* Functions of programs for sixteen numbers at once, using the text of gl/functions.h. OpenCL C only. */
#pragma once

#include "kernels/frame/pack/pack_vector.h"
#include "kernels/gl/functions.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/functions_lanes.h"
#include "kernels/one_lanes.h"
