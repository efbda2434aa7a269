/*
 * Converts the result of comparing eight lanes (a set lane has all bits set). OpenCL C only. The language has any(),
 * but no way to get all eight bits at once. If the compiler and the processor have an instruction for that, it is used.
 */
#pragma once

/*
 * Sixteen lanes are passed by value, also to fma() and select(). Clang warns if the processor has narrower registers,
 * as code for a wider processor would pass them differently. A program and its device's library are compiled for the
 * same processor, so no such code exists.
 */
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpsabi"
#endif

#if defined(__has_builtin) && defined(__AVX__)
#if __has_builtin(__builtin_ia32_movmskps256)
#define LANES_MOVEMASK 1
#endif
#endif

#if defined(__has_builtin) && defined(__AVX512DQ__)
#if __has_builtin(__builtin_ia32_cvtd2mask512)
#define LANES_MASK16 1
#endif
#if __has_builtin(__builtin_ia32_permvarsf512)
#define LANES_PERMUTE16 1
#endif
#endif

/*
 * Compiler builtins, if the compiler accepts Clang's extensions: PoCL's compiles for a processor, Intel's targets SPIR.
 * Others accept them but fail later (rusticl 22.3: "Unexpected llvm intrinsic: llvm.prefetch"). LANES_PORTABLE: for
 * interpreters of kernels.
 */
#if defined(__has_builtin) && !defined(LANES_PORTABLE) && \
	(defined(__x86_64__) || defined(__aarch64__) || defined(__SPIR__))
#define LANES_OWN(function) __has_builtin(function)
#else
#define LANES_OWN(function) 0
#endif

#if LANES_OWN(__builtin_reduce_or)
#define LANES_REDUCE 1
#endif

/* Prefetch the data at p, which is about to be read. The effect of the language's own prefetch is up to the device, and
 * PoCL ignores it. */
#if LANES_OWN(__builtin_prefetch)
#define PREFETCH(p) __builtin_prefetch((const void *)(size_t)(p))
#else
#define PREFETCH(p) ((void)(p))
#endif

/* A bit for each lane. */
static inline uint lane_bits(int8 mask)
{
#ifdef LANES_MOVEMASK
	return (uint)__builtin_ia32_movmskps256(as_float8(mask));
#else
	const int8 bits = mask & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
	const int4 four = bits.lo | bits.hi;
	const int2 two = four.lo | four.hi;

	return (uint)(two.lo | two.hi);
#endif
}

static inline int any_lane(int8 mask)
{
#ifdef LANES_REDUCE
	return __builtin_reduce_or(mask) != 0;
#else
	return lane_bits(mask) != 0;
#endif
}

/* Minimum and maximum as a single processor instruction: if x is NaN, the result is y. */
static inline float8 lanes_min(float8 x, float8 y)
{
	return select(y, x, x < y);
}

static inline float8 lanes_max(float8 x, float8 y)
{
	return select(y, x, x > y);
}

/* Keep sixteen lanes in one register if there is one; the compiler would rather split them. */
#if defined(__AVX512F__) && defined(__has_attribute)
#if __has_attribute(min_vector_width)
#define WIDE_VECTORS __attribute__((min_vector_width(512)))
#endif
#endif
#ifndef WIDE_VECTORS
#define WIDE_VECTORS
#endif

/* Rows of a packet: sixteen rays. Processors with eight lanes process them as two halves, which also hides latency. */
typedef float16 packf;
typedef int16 packi;
typedef uint16 packu;
#define PACK_LANES ((packi)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

static inline int any_pack(packi mask)
{
#ifdef LANES_MASK16
	return (ushort)__builtin_ia32_cvtd2mask512(mask) != 0;
#elif defined(LANES_REDUCE)
	return __builtin_reduce_or(mask) != 0;
#else
	return any_lane(mask.lo | mask.hi);
#endif
}

/* A bit for each lane. */
static inline uint pack_bits(packi mask)
{
#ifdef LANES_MASK16
	return (ushort)__builtin_ia32_cvtd2mask512(mask);
#else
	return lane_bits(mask.lo) | lane_bits(mask.hi) << 8;
#endif
}

/* The lanes whose bits are set. */
static inline packi lanes_pack(uint bits)
{
	return ((packi)((int)bits) >> PACK_LANES & 1) != 0;
}

/* table[index & 15], lane by lane. */
WIDE_VECTORS static inline packf pack_pick(packf table, packi index)
{
#ifdef LANES_PERMUTE16
	return __builtin_ia32_permvarsf512(table, index);
#else
	packf out;

	for (int lane = 0; lane < 16; lane++)
		((float *)&out)[lane] = ((const float *)&table)[((const int *)&index)[lane] & 15];
	return out;
#endif
}

/*
 * Load words at sixteen indices of a table in any address space. Indices are below 2^31. The language has no such
 * function, and LLVM 15 compiles a loop to separate loads and moves.
 */
#if LANES_OWN(__builtin_ia32_gathersiv16si) && defined(__AVX512F__)
#define PACK_WORDS(table, place) \
	as_uint16(__builtin_ia32_gathersiv16si((packi)(0), (const void *)(size_t)(table), as_int16(place), (ushort)0xffff, 4))
#elif LANES_OWN(__builtin_ia32_gatherd_d256) && defined(__AVX2__)
#define PACK_EIGHT_WORDS(table, place) \
	__builtin_ia32_gatherd_d256((int8)(0), (const int *)(size_t)(table), as_int8(place), (int8)(-1), 4)
#define PACK_WORDS(table, place) \
	as_uint16((packi)(PACK_EIGHT_WORDS(table, (place).lo), PACK_EIGHT_WORDS(table, (place).hi)))
#else
#define PACK_WORD(table, place, lane) as_uint((table)[(place).lane])
#define PACK_FOUR_WORDS(table, place, a, b, c, d) \
	PACK_WORD(table, place, a), PACK_WORD(table, place, b), PACK_WORD(table, place, c), PACK_WORD(table, place, d)
#define PACK_WORDS(table, place) \
	(packu)(PACK_FOUR_WORDS(table, place, s0, s1, s2, s3), PACK_FOUR_WORDS(table, place, s4, s5, s6, s7), \
	        PACK_FOUR_WORDS(table, place, s8, s9, sa, sb), PACK_FOUR_WORDS(table, place, sc, sd, se, sf))
#endif

static inline packf pack_min(packf x, packf y)
{
	return select(y, x, x < y);
}

static inline packf pack_max(packf x, packf y)
{
	return select(y, x, x > y);
}
