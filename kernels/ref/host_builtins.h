/*
 * OpenCL C 1.2 on processors that clang compiles C for (-cl-no-stdinc): the types and built-in functions that kernels
 * and hooks use (hook_host.h), and how tests/check/host_cl.c starts kernels. It promises no more than the
 * specification. HOST_OTHERWISE selects a different answer wherever the specification allows several.
 */
#ifndef KERNELS_REF_HOST_BUILTINS_H
#define KERNELS_REF_HOST_BUILTINS_H

typedef unsigned char uchar;
typedef unsigned short ushort;
typedef unsigned int uint;
typedef unsigned long ulong, size_t;
typedef long ptrdiff_t;

#define HOST_VECTORS(T) \
	typedef T T##2 __attribute__((ext_vector_type(2))); \
	typedef T T##3 __attribute__((ext_vector_type(3))); \
	typedef T T##4 __attribute__((ext_vector_type(4))); \
	typedef T T##8 __attribute__((ext_vector_type(8))); \
	typedef T T##16 __attribute__((ext_vector_type(16)));
HOST_VECTORS(char)
HOST_VECTORS(uchar)
HOST_VECTORS(short)
HOST_VECTORS(ushort)
HOST_VECTORS(int)
HOST_VECTORS(uint)
HOST_VECTORS(long)
HOST_VECTORS(ulong)
HOST_VECTORS(float)

#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
#define FLT_MAX 3.402823466e+38f
#define FLT_MIN 1.175494351e-38f
#define FLT_EPSILON 1.192092896e-7f
#define INT_MAX 0x7fffffff
#define UINT_MAX 0xffffffffu
#define M_PI_F 3.14159274101257f

#define HOST_OVER static inline __attribute__((overloadable, unused))

/* --- One number -------------------------------------------------------------------------------------------------- */

float logf(float), log2f(float), tanf(float), asinf(float), acosf(float), atanf(float), atan2f(float, float),
	fmodf(float, float), roundf(float), truncf(float), hypotf(float, float);
float sqrtf(float), floorf(float), ceilf(float), rintf(float), powf(float, float), expf(float), exp2f(float),
	cosf(float), sinf(float);
ulong host_item(void); /* host_cl.c */

#ifdef HOST_OTHERWISE
/* Changes a result whose precision is only guaranteed to some units in the last place. */
HOST_OVER float host_off(float x)
{
	return x * 1.00000024f;
}
#else
#define host_off(x) (x)
#endif

HOST_OVER size_t get_global_id(uint dimension)
{
	return dimension ? 0 : host_item();
}

HOST_OVER float fma(float x, float y, float z)
{
	return __builtin_fmaf(x, y, z);
}

HOST_OVER float fabs(float x)
{
	return __builtin_fabsf(x);
}

HOST_OVER float copysign(float x, float y)
{
	return __builtin_copysignf(x, y);
}

/*
 * With one NaN, the result is the other number. The specification leaves open which zero is smaller, and what min() and
 * max() do with a NaN.
 */
#ifdef HOST_OTHERWISE
HOST_OVER float fmin(float x, float y)
{
	return x != x || y < x || (y == x && !__builtin_signbit(y)) ? y : x;
}

HOST_OVER float fmax(float x, float y)
{
	return x != x || y > x || (y == x && __builtin_signbit(y)) ? y : x;
}

HOST_OVER float min(float x, float y)
{
	return x != x || y != y ? -7e30f : x < y ? x : y;
}

HOST_OVER float max(float x, float y)
{
	return x != x || y != y ? 7e30f : x > y ? x : y;
}
#else
HOST_OVER float fmin(float x, float y)
{
	return y != y || x < y || (x == y && __builtin_signbit(x)) ? x : y;
}

HOST_OVER float fmax(float x, float y)
{
	return y != y || x > y || (x == y && !__builtin_signbit(x)) ? x : y;
}

HOST_OVER float min(float x, float y)
{
	return y < x ? y : x;
}

HOST_OVER float max(float x, float y)
{
	return x < y ? y : x;
}
#endif

#define HOST_INTEGER(T) \
	HOST_OVER T min(T x, T y) \
	{ \
		return y < x ? y : x; \
	} \
	HOST_OVER T max(T x, T y) \
	{ \
		return x < y ? y : x; \
	} \
	HOST_OVER T clamp(T x, T least, T most) \
	{ \
		return min(max(x, least), most); \
	}
HOST_INTEGER(int)
HOST_INTEGER(uint)
HOST_INTEGER(long)
HOST_INTEGER(ulong)

HOST_OVER float clamp(float x, float least, float most)
{
	return min(max(x, least), most);
}

HOST_OVER float sqrt(float x)
{
	return host_off(sqrtf(x));
}

HOST_OVER float floor(float x)
{
	return floorf(x);
}

HOST_OVER float ceil(float x)
{
	return ceilf(x);
}

HOST_OVER float rint(float x)
{
	return rintf(x);
}

HOST_OVER float pow(float x, float y)
{
	return host_off(powf(x, y));
}

HOST_OVER float exp(float x)
{
	return host_off(expf(x));
}

HOST_OVER float exp2(float x)
{
	return host_off(exp2f(x));
}

HOST_OVER float cos(float x)
{
	return host_off(cosf(x));
}

HOST_OVER float sin(float x)
{
	return host_off(sinf(x));
}

HOST_OVER int isfinite(float x)
{
	return __builtin_isfinite(x);
}

HOST_OVER int popcount(int x)
{
	return __builtin_popcount((uint)x);
}

HOST_OVER uint popcount(uint x)
{
	return (uint)__builtin_popcount(x);
}

HOST_OVER ulong popcount(ulong x)
{
	return (ulong)__builtin_popcountl(x);
}

HOST_OVER int clz(int x)
{
	return x ? __builtin_clz((uint)x) : 32;
}

HOST_OVER uint clz(uint x)
{
	return x ? (uint)__builtin_clz(x) : 32;
}

/* --- Several ----------------------------------------------------------------------------------------------------- */

#define HOST_WIDTHS(X, T) X(T, 2) X(T, 4) X(T, 8) X(T, 16)
#define HOST_LANES(T, n, expression) \
	{ \
		T##n r; \
\
		for (int i = 0; i < n; i++) \
			r[i] = expression; \
		return r; \
	}

#define HOST_FLOATS(T, n) \
	HOST_OVER T##n fma(T##n x, T##n y, T##n z) HOST_LANES(T, n, fma(x[i], y[i], z[i])) \
	HOST_OVER T##n fabs(T##n x) HOST_LANES(T, n, fabs(x[i])) \
	HOST_OVER T##n sqrt(T##n x) HOST_LANES(T, n, sqrt(x[i])) \
	HOST_OVER T##n floor(T##n x) HOST_LANES(T, n, floor(x[i])) \
	HOST_OVER T##n ceil(T##n x) HOST_LANES(T, n, ceil(x[i])) \
	HOST_OVER T##n rint(T##n x) HOST_LANES(T, n, rint(x[i])) \
	HOST_OVER T##n exp2(T##n x) HOST_LANES(T, n, exp2(x[i])) \
	HOST_OVER T##n exp(T##n x) HOST_LANES(T, n, exp(x[i])) \
	HOST_OVER T##n pow(T##n x, T##n y) HOST_LANES(T, n, pow(x[i], y[i])) \
	HOST_OVER T##n copysign(T##n x, T##n y) HOST_LANES(T, n, copysign(x[i], y[i])) \
	HOST_OVER T##n fmin(T##n x, T##n y) HOST_LANES(T, n, fmin(x[i], y[i])) \
	HOST_OVER T##n fmax(T##n x, T##n y) HOST_LANES(T, n, fmax(x[i], y[i])) \
	HOST_OVER int##n isfinite(T##n x) HOST_LANES(int, n, -isfinite(x[i])) \
	HOST_OVER int##n isnan(T##n x) HOST_LANES(int, n, -(x[i] != x[i])) \
	HOST_OVER T##n select(T##n x, T##n y, int##n which) HOST_LANES(T, n, which[i] < 0 ? y[i] : x[i]) \
	HOST_OVER T##n select(T##n x, T##n y, uint##n which) HOST_LANES(T, n, which[i] >> 31 ? y[i] : x[i]) \
	HOST_OVER T##n convert_float##n(int##n x) HOST_LANES(T, n, (float)x[i]) \
	HOST_OVER T##n convert_float##n(uint##n x) HOST_LANES(T, n, (float)x[i]) \
	HOST_OVER T##n convert_float##n(long##n x) HOST_LANES(T, n, (float)x[i])
HOST_WIDTHS(HOST_FLOATS, float)

/* Vectors of any number type. */
#define HOST_NUMBERS(T, n) \
	HOST_OVER T##n min(T##n x, T##n y) HOST_LANES(T, n, min(x[i], y[i])) \
	HOST_OVER T##n max(T##n x, T##n y) HOST_LANES(T, n, max(x[i], y[i])) \
	HOST_OVER T##n min(T##n x, T y) HOST_LANES(T, n, min(x[i], y)) \
	HOST_OVER T##n max(T##n x, T y) HOST_LANES(T, n, max(x[i], y)) \
	HOST_OVER T##n clamp(T##n x, T##n least, T##n most) HOST_LANES(T, n, clamp(x[i], least[i], most[i])) \
	HOST_OVER T##n clamp(T##n x, T least, T most) HOST_LANES(T, n, clamp(x[i], least, most)) \
	HOST_MEMORY(T, n, __global) \
	HOST_MEMORY(T, n, __private)
#define HOST_MEMORY(T, n, space) \
	HOST_OVER T##n vload##n(size_t at, const space T *p) HOST_LANES(T, n, p[n * at + (size_t)i]) \
	HOST_OVER void vstore##n(T##n x, size_t at, space T *p) \
	{ \
		for (size_t i = 0; i < n; i++) \
			p[n * at + i] = x[i]; \
	}
HOST_WIDTHS(HOST_NUMBERS, float)
HOST_WIDTHS(HOST_NUMBERS, int)
HOST_WIDTHS(HOST_NUMBERS, uint)
HOST_WIDTHS(HOST_NUMBERS, long)

#define HOST_INTEGERS(T, n) \
	HOST_OVER T##n select(T##n x, T##n y, int##n which) HOST_LANES(T, n, which[i] < 0 ? y[i] : x[i]) \
	HOST_OVER T##n select(T##n x, T##n y, uint##n which) HOST_LANES(T, n, which[i] >> 31 ? y[i] : x[i]) \
	HOST_OVER T##n popcount(T##n x) HOST_LANES(T, n, popcount(x[i]))
HOST_WIDTHS(HOST_INTEGERS, int)
HOST_WIDTHS(HOST_INTEGERS, uint)

#define HOST_CONVERSIONS(T, n) \
	HOST_OVER int##n convert_int##n(T##n x) HOST_LANES(int, n, (int)x[i]) \
	HOST_OVER uint##n convert_uint##n(T##n x) HOST_LANES(uint, n, (uint)x[i]) \
	HOST_OVER ushort##n convert_ushort##n(T##n x) HOST_LANES(ushort, n, (ushort)x[i]) \
	HOST_OVER long##n convert_long##n(T##n x) HOST_LANES(long, n, (long)x[i])
HOST_WIDTHS(HOST_CONVERSIONS, float)
HOST_WIDTHS(HOST_CONVERSIONS, int)
HOST_WIDTHS(HOST_CONVERSIONS, uint)
HOST_WIDTHS(HOST_CONVERSIONS, long)

#define HOST_CHOICE(T) \
	HOST_OVER T select(T x, T y, int which) \
	{ \
		return which ? y : x; \
	} \
	HOST_OVER T select(T x, T y, uint which) \
	{ \
		return which ? y : x; \
	}
HOST_CHOICE(float)
HOST_CHOICE(int)
HOST_CHOICE(uint)

#define HOST_TRUTH(T, n) \
	HOST_OVER int any(T##n x) \
	{ \
		int r = 0; \
\
		for (int i = 0; i < n; i++) \
			r |= x[i] < 0; \
		return r; \
	} \
	HOST_OVER int all(T##n x) \
	{ \
		int r = 1; \
\
		for (int i = 0; i < n; i++) \
			r &= x[i] < 0; \
		return r; \
	}
HOST_WIDTHS(HOST_TRUTH, int)

#define convert_int(x) ((int)(x))
#define convert_uint(x) ((uint)(x))
#define convert_float(x) ((float)(x))
#define as_int(x) __builtin_astype((x), int)
#define as_uint(x) __builtin_astype((x), uint)
#define as_float(x) __builtin_astype((x), float)
#define as_int4(x) __builtin_astype((x), int4)
#define as_uint4(x) __builtin_astype((x), uint4)
#define as_float4(x) __builtin_astype((x), float4)
#define as_int8(x) __builtin_astype((x), int8)
#define as_uint8(x) __builtin_astype((x), uint8)
#define as_float8(x) __builtin_astype((x), float8)
#define as_int16(x) __builtin_astype((x), int16)
#define as_uint16(x) __builtin_astype((x), uint16)
#define as_float16(x) __builtin_astype((x), float16)
#define as_ushort8(x) __builtin_astype((x), ushort8)
#define as_short16(x) __builtin_astype((x), short16)
#define as_ushort16(x) __builtin_astype((x), ushort16)

/* --- For hooks --------------------------------------------------------------------------------------------------- */

#define HOST_CALL(name, called) \
	HOST_OVER float name(float x) \
	{ \
		return host_off(called(x)); \
	}
HOST_CALL(log, logf)
HOST_CALL(log2, log2f)
HOST_CALL(tan, tanf)
HOST_CALL(asin, asinf)
HOST_CALL(acos, acosf)
HOST_CALL(atan, atanf)
HOST_CALL(round, roundf)
HOST_CALL(trunc, truncf)

HOST_OVER float atan2(float y, float x)
{
	return host_off(atan2f(y, x));
}

HOST_OVER float fmod(float x, float y)
{
	return fmodf(x, y);
}

HOST_OVER float hypot(float x, float y)
{
	return host_off(hypotf(x, y));
}

HOST_OVER float mad(float x, float y, float z)
{
	return x * y + z;
}

HOST_OVER float mix(float x, float y, float share)
{
	return x + (y - x) * share;
}

HOST_OVER float step(float edge, float x)
{
	return x < edge ? 0.0f : 1.0f;
}

HOST_OVER float smoothstep(float from, float to, float x)
{
	const float t = clamp((x - from) / (to - from), 0.0f, 1.0f);

	return t * t * (3.0f - 2.0f * t);
}

HOST_OVER float sign(float x)
{
	return x > 0.0f ? 1.0f : x < 0.0f ? -1.0f : x == x ? x : 0.0f;
}

HOST_OVER float radians(float degrees)
{
	return degrees * 0.017453293f;
}

HOST_OVER float degrees(float radians)
{
	return radians * 57.29578f;
}

HOST_OVER int isinf(float x)
{
	return __builtin_isinf(x);
}

HOST_OVER int isnan(float x)
{
	return x != x;
}

HOST_OVER uint abs(int x)
{
	return x < 0 ? 0u - (uint)x : (uint)x;
}

#define HOST_SPACE(T, n) \
	HOST_OVER T dot(T##n x, T##n y) \
	{ \
		T sum = 0; \
\
		for (int i = 0; i < n; i++) \
			sum += x[i] * y[i]; \
		return sum; \
	} \
	HOST_OVER T length(T##n x) \
	{ \
		return sqrt(dot(x, x)); \
	} \
	HOST_OVER T distance(T##n x, T##n y) \
	{ \
		return length(x - y); \
	} \
	HOST_OVER T##n normalize(T##n x) \
	{ \
		const T size = length(x); \
\
		return size > 0 ? x / size : x; \
	} \
	HOST_OVER T##n sin(T##n x) HOST_LANES(T, n, sin(x[i])) \
	HOST_OVER T##n cos(T##n x) HOST_LANES(T, n, cos(x[i])) \
	HOST_OVER T##n log(T##n x) HOST_LANES(T, n, log(x[i])) \
	HOST_OVER T##n sign(T##n x) HOST_LANES(T, n, sign(x[i])) \
	HOST_OVER T##n fmod(T##n x, T##n y) HOST_LANES(T, n, fmod(x[i], y[i])) \
	HOST_OVER T##n mad(T##n x, T##n y, T##n z) HOST_LANES(T, n, mad(x[i], y[i], z[i])) \
	HOST_OVER T##n mix(T##n x, T##n y, T##n share) HOST_LANES(T, n, mix(x[i], y[i], share[i])) \
	HOST_OVER T##n mix(T##n x, T##n y, T share) HOST_LANES(T, n, mix(x[i], y[i], share)) \
	HOST_OVER T##n step(T##n edge, T##n x) HOST_LANES(T, n, step(edge[i], x[i])) \
	HOST_OVER T##n step(T edge, T##n x) HOST_LANES(T, n, step(edge, x[i])) \
	HOST_OVER T##n smoothstep(T from, T to, T##n x) HOST_LANES(T, n, smoothstep(from, to, x[i])) \
	HOST_OVER int##n convert_int##n##_rtn(T##n x) HOST_LANES(int, n, (int)floor(x[i])) \
	HOST_OVER int##n convert_int##n##_rte(T##n x) HOST_LANES(int, n, (int)rint(x[i]))
HOST_SPACE(float, 2)
HOST_SPACE(float, 4)

HOST_OVER float4 cross(float4 x, float4 y)
{
	return (float4)(x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x, 0.0f);
}

/* --- Starting kernels -------------------------------------------------------------------------------------------- */

/* host_run_NAME(arguments, first, last): runs work items first .. last - 1, the last one first. An argument is the
 * address of its value. */
#define HOST_BUFFER(element, name) \
	__global element_##element *host_of_##name = (__global element_##element *)*(ulong *)*host_arguments++;
#define HOST_VALUE(element, name) element_##element host_of_##name = *(element_##element *)*host_arguments++;
#define HOST_GROUP(list, name) ARGUMENTS_##list(HOST_BUFFER, HOST_BUFFER, HOST_VALUE, HOST_GROUP, KERNEL_NOTHING)
#define HOST_NAME(element, name) host_of_##name
#define HOST_NAMES(list, name) ARGUMENTS_##list(HOST_NAME, HOST_NAME, HOST_NAME, HOST_NAMES, KERNEL_COMMA)
#define HOST_ENTRY(name, list) \
	void host_run_##name(void **host_arguments, ulong host_first, ulong host_last); \
	void host_run_##name(void **host_arguments, ulong host_first, ulong host_last) \
	{ \
		ARGUMENTS_##list(HOST_BUFFER, HOST_BUFFER, HOST_VALUE, HOST_GROUP, KERNEL_NOTHING) \
		for (ulong host_i = host_last; host_i-- > host_first;) { \
			host_begin(host_i); \
			name(ARGUMENTS_##list(HOST_NAME, HOST_NAME, HOST_NAME, HOST_NAMES, KERNEL_COMMA)); \
		} \
	}
void host_begin(ulong item); /* host_cl.c */

#endif
