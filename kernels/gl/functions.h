/*
 * Sine, cosine, powers and logarithms of programs, to the last bit of llvmpipe's (Mesa 22.3.6, lp_bld_arit.c) on
 * processors that multiply and add at once: places and depths may be made of them. Cephes' sinf and cosf, and
 * polynomials of Mesa's own.
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

/* Factors: of eighths of a turn, in three parts; of the sine's and the cosine's polynomials in the square. */
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

/* 2 to the power of [0, 1[ */
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

static inline float function_turn(float a, uint32_t is_cosine)
{
	const float far = M_ABS(a), eighths = far * TURN_EIGHTHS;
	const uint32_t next = (eighths < 2147483648.0f ? (uint32_t)eighths : 0x80000000u) + 1u, whole = next & ~1u;
	const float n = whole & 0x80000000u ? -2147483648.0f : (float)whole;
	const float x = M_FMA(n, TURN_PART2, M_FMA(n, TURN_PART1, M_FMA(n, TURN_PART0, far))), z = x * x;
	const float sine = M_FMA(M_FMA(M_FMA(z, TURN_SINE0, TURN_SINE1), z, TURN_SINE2) * z, x, x);
	const float cosine = (M_FMA(M_FMA(z, TURN_COSINE0, TURN_COSINE1), z, TURN_COSINE2) * z * z - z * 0.5f) + 1.0f;
	const uint32_t from = is_cosine ? whole - 2u : whole;
	const uint32_t sign = (is_cosine ? ~from << 29 : M_BITS(a) ^ (next << 29)) & 0x80000000u;

	return far < INFINITY ? M_MIN(M_MAX(M_FLOAT(M_BITS(from & 2u ? cosine : sine) ^ sign), -1.0f), 1.0f) : FUNCTION_NAN;
}

static inline float function_exp2(float a)
{
	const float x = a > FUNCTION_MOST_EXPONENT  ? FUNCTION_MOST_EXPONENT :
	                a < FUNCTION_LEAST_EXPONENT ? FUNCTION_LEAST_EXPONENT :
	                                              a;
	const float whole = M_FLOOR(x), f = x - whole, z = f * f;
	const float even = M_FMA(z, M_FMA(z, EXP2_FACTOR4, EXP2_FACTOR2), 1.0f);
	const float odd = M_FMA(z, M_FMA(z, EXP2_FACTOR5, EXP2_FACTOR3), EXP2_FACTOR1);

	return x == x ? M_FLOAT((uint32_t)((int)whole + 127) << 23) * M_FMA(odd, f, even) : a;
}

/* What is not normal counts as 0, as llvmpipe has the processor take it. */
static inline float function_log2(float a)
{
	const uint32_t bits = M_BITS(a), exponent = bits & 0x7f800000u;
	const float mantissa = M_FLOAT((bits & 0x7fffffu) | 0x3f800000u), y = (mantissa - 1.0f) / (mantissa + 1.0f),
		    z = y * y, w = z * z;
	const float even = M_FMA(w, M_FMA(w, LOG2_FACTOR4, LOG2_FACTOR2), LOG2_FACTOR0),
		    odd = M_FMA(w, LOG2_FACTOR3, LOG2_FACTOR1);

	if (exponent == 0u)
		return -INFINITY;
	if (!(a > 0.0f))
		return FUNCTION_NAN;
	return a < INFINITY ? M_FMA(y, M_FMA(odd, z, even), (float)((int)(exponent >> 23) - 127)) : a;
}

/* 0 to any power is 0, to that of 0 as well (lp_build_pow); what is not normal counts as 0. */
static inline float function_power(float a, float b)
{
	return (M_BITS(a) & 0x7f800000u) == 0u ? 0.0f : function_exp2(function_log2(a) * b);
}
