/*
 * Sine, cosine, powers and logarithms for programs, matching the last bit of llvmpipe's (Mesa 22.3.6, lp_bld_arit.c) on
 * processors with fused multiply-add, since positions and depths may depend on them. Cephes' sinf and cosf, and Mesa's
 * own polynomials.
 */
#pragma once

#include "kernels/common.h"

#ifdef __OPENCL_VERSION__
#define FUNCTION_NAN nan(0u)
#else
#define FUNCTION_NAN NAN
#endif

#define FUNCTION_LEAST_EXPONENT -126.99999f
#define FUNCTION_MOST_EXPONENT 128.0f

/* Constants: eighths of a turn, in three parts; polynomials of sine and cosine in the square. */
#define TURN_EIGHTHS 1.27323954473516f
#define TURN_PART0 -0.78515625f
#define TURN_PART1 -2.4187564849853515625e-4f
#define TURN_PART2 -3.77489497744594108e-8f
#define TURN_SINE0 -1.9515295891e-4f
#define TURN_SINE1 8.3321608736e-3f
#define TURN_SINE2 -1.6666654611e-1f
#define TURN_COSINE0 2.443315711809948e-5f
#define TURN_COSINE1 -1.388731625493765e-3f
#define TURN_COSINE2 4.166664568298827e-2f

/* 2 to a power in [0, 1[ */
#define EXP2_FACTOR1 0.693153073200168932794f
#define EXP2_FACTOR2 0.240153617044375388211f
#define EXP2_FACTOR3 0.0558263180532956664775f
#define EXP2_FACTOR4 0.00898934009049466391101f
#define EXP2_FACTOR5 0.00187757667519147912699f

/* log2((1 + y) / (1 - y)) / y, in the square of y */
#define LOG2_FACTOR0 2.88539009343309178325f
#define LOG2_FACTOR1 0.961791550404184197881f
#define LOG2_FACTOR2 0.577440339438736392009f
#define LOG2_FACTOR3 0.403343858251329912514f
#define LOG2_FACTOR4 0.406718052498846252698f

#include "kernels/gl/functions_lanes.h"
