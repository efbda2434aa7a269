/*
 * Shading is written in the common subset of C11 and OpenCL C 1.2. This header names the maths functions and defines
 * small vectors. Code that includes only this and shared.h compiles both as a kernel and as its C twin.
 *
 * Both sides compile without contraction (-ffp-contract=off; the pragma below), because the twin is the kernel's
 * specification.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#define M_SQRT(x) sqrt(x)
#define M_FMA(x, y, z) fma(x, y, z)
#define M_POW(x, y) pow(x, y)
#define M_EXP(x) exp(x)
#define M_EXP2(x) exp2(x)
#define M_FLOOR(x) floor(x)
#define M_CEIL(x) ceil(x)
#define M_RINT(x) rint(x)
#define M_ABS(x) fabs(x)
#define M_MIN(x, y) fmin(x, y)
#define M_MAX(x, y) fmax(x, y)
#define M_COS(x) cos(x)
#define M_SIN(x) sin(x)
#define M_BITS(x) as_uint(x)
#define M_FLOAT(x) as_float(x)
#else
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>
#define M_SQRT(x) sqrtf(x)
#define M_FMA(x, y, z) fmaf(x, y, z)
#define M_POW(x, y) powf(x, y)
#define M_EXP(x) expf(x)
#define M_EXP2(x) exp2f(x)
#define M_FLOOR(x) floorf(x)
#define M_CEIL(x) ceilf(x)
#define M_RINT(x) rintf(x)
#define M_ABS(x) fabsf(x)
#define M_MIN(x, y) fminf(x, y)
#define M_MAX(x, y) fmaxf(x, y)
#define M_COS(x) cosf(x)
#define M_SIN(x) sinf(x)
#define M_BITS(x) common_bits(x)
#define M_FLOAT(x) common_float(x)

static inline uint32_t common_bits(float x)
{
	uint32_t bits;

	memcpy(&bits, &x, sizeof(bits));
	return bits;
}

static inline float common_float(uint32_t bits)
{
	float x;

	memcpy(&x, &bits, sizeof(x));
	return x;
}
#endif

struct vec3 {
	float x, y, z;
};

struct vec4 {
	float x, y, z, w;
};

static inline struct vec3 v3(float x, float y, float z)
{
	struct vec3 v;

	v.x = x;
	v.y = y;
	v.z = z;
	return v;
}

static inline struct vec4 v4(float x, float y, float z, float w)
{
	struct vec4 v;

	v.x = x;
	v.y = y;
	v.z = z;
	v.w = w;
	return v;
}

static inline struct vec3 v3_load(GLOBAL const float *p)
{
	return v3(p[0], p[1], p[2]);
}

static inline struct vec4 v4_load(GLOBAL const float *p)
{
	return v4(p[0], p[1], p[2], p[3]);
}

static inline void v3_store(GLOBAL float *p, struct vec3 v)
{
	p[0] = v.x;
	p[1] = v.y;
	p[2] = v.z;
}

static inline void v4_store(GLOBAL float *p, struct vec4 v)
{
	p[0] = v.x;
	p[1] = v.y;
	p[2] = v.z;
	p[3] = v.w;
}

#include "kernels/one_lanes.h"
#include "kernels/vector_lanes.h"
