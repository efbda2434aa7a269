/*
 * Boxes for the builders, as vectors. They store -lo and hi side by side, so that growing a box takes only maxima. The
 * fourth lane of each half is carried along. Arithmetic and comparisons use the compiler's vector operators. The rest
 * is here, for the instruction set that the including file is compiled for: AVX, SSE2, or neither.
 */
#pragma once

#include <stdint.h>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "kernels/shared.h"

typedef float vec4 __attribute__((vector_size(16)));
typedef int32_t ivec4 __attribute__((vector_size(16)));

#define VEC4(x) ((vec4){ x, x, x, x })

/** a < b ? a : b in each lane; b if either is a NaN. */
static inline vec4 vec4_min(vec4 a, vec4 b)
{
#ifdef __SSE2__
	return _mm_min_ps(a, b);
#else
	const ivec4 less = a < b;

	return (vec4)(((ivec4)a & less) | ((ivec4)b & ~less));
#endif
}

/** a > b ? a : b in each lane; b if either is a NaN. */
static inline vec4 vec4_max(vec4 a, vec4 b)
{
#ifdef __SSE2__
	return _mm_max_ps(a, b);
#else
	const ivec4 more = a > b;

	return (vec4)(((ivec4)a & more) | ((ivec4)b & ~more));
#endif
}

/** 1 if the comparison holds in lane 0. */
static inline uint32_t vec4_first(ivec4 m)
{
#ifdef __SSE2__
	return _mm_movemask_ps((__m128)m) & 1;
#else
	return (uint32_t)m[0] & 1;
#endif
}

#ifdef __AVX__
typedef __m256 box8;

static inline box8 box8_make(vec4 negative_lo, vec4 hi)
{
	return _mm256_insertf128_ps(_mm256_castps128_ps256(negative_lo), hi, 1);
}

static inline vec4 box8_negative_lo(box8 b)
{
	return _mm256_castps256_ps128(b);
}

static inline vec4 box8_hi(box8 b)
{
	return _mm256_extractf128_ps(b, 1);
}

/** The box around both; b in lanes where a is a NaN. */
static inline box8 box8_join(box8 a, box8 b)
{
	return _mm256_max_ps(a, b);
}
#else
typedef struct {
	vec4 negative_lo, hi;
} box8;

static inline box8 box8_make(vec4 negative_lo, vec4 hi)
{
	return (box8){ negative_lo, hi };
}

static inline vec4 box8_negative_lo(box8 b)
{
	return b.negative_lo;
}

static inline vec4 box8_hi(box8 b)
{
	return b.hi;
}

static inline box8 box8_join(box8 a, box8 b)
{
	return (box8){ vec4_max(a.negative_lo, b.negative_lo), vec4_max(a.hi, b.hi) };
}
#endif

/** The empty box. */
static inline box8 box8_empty(void)
{
	return box8_make(VEC4(-BVH_EMPTY_LO), VEC4(BVH_EMPTY_HI));
}

static inline vec4 box8_size(box8 b)
{
	return box8_hi(b) + box8_negative_lo(b);
}

/** Twice the centre. */
static inline vec4 box8_centre(box8 b)
{
	return box8_hi(b) - box8_negative_lo(b);
}

static inline float box8_half_area(box8 b)
{
	const vec4 d = box8_size(b);

	return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/** The half areas of four boxes. */
static inline vec4 box8_half_areas(box8 a, box8 b, box8 c, box8 d)
{
	const vec4 p = box8_size(a), q = box8_size(b), r = box8_size(c), s = box8_size(d);
	const vec4 pq = __builtin_shufflevector(p, q, 0, 4, 1, 5), rs = __builtin_shufflevector(r, s, 0, 4, 1, 5);
	const vec4 pq2 = __builtin_shufflevector(p, q, 2, 6, 2, 6), rs2 = __builtin_shufflevector(r, s, 2, 6, 2, 6);
	const vec4 x = __builtin_shufflevector(pq, rs, 0, 1, 4, 5), y = __builtin_shufflevector(pq, rs, 2, 3, 6, 7);
	const vec4 z = __builtin_shufflevector(pq2, rs2, 0, 1, 4, 5);

	return x * y + y * z + z * x;
}
