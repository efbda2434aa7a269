/*
 * sRGB's transfer function (IEC 61966-2-1) both ways: GL's numbers are display-referred, light is not. By nothing but
 * what is the same on every device.
 */
#pragma once

#include "kernels/common.h"

/*
 * x^exponent for 1e-30 < x < 1e15 and exponents up to 2.4, to 5e-7 of itself: log2 of the mantissa by its series in (m
 * - 1) / (m + 1), times the exponent, and 2 to that by its own series.
 */
static inline float encode_power(float x, float exponent)
{
	uint32_t bits = M_BITS(x) - 0x3f3504f3u; /* mantissas from 1/sqrt(2) to sqrt(2) */
	float m = M_FLOAT((bits & 0x7fffffu) + 0x3f3504f3u), e = (float)((int)bits >> 23);
	float s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
	float log2m = s * (2.885390082f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * 0.412198583f)));
	float up = exponent * (e + log2m) + 12582912.0f, whole = up - 12582912.0f; /* 1.5 x 2^23: what is added is rounded */
	float f = (exponent * e - whole) + exponent * log2m;
	float p = 1.0f + f * (0.6931471806f + f * (0.2402265070f + f * (0.0555041087f + f * (0.0096181291f +
	          f * (0.0013333558f + f * 0.0001540353f)))));

	return p * M_FLOAT((M_BITS(up) - 0x4b400000u + 127u) << 23);
}

/* Display-referred to linear light; odd. */
static inline float encode_linear(float display)
{
	float x = M_FLOAT(M_BITS(display) & 0x7fffffffu), large = x < 1.0e15f ? x : 1.0e15f;
	float y = encode_power((large + 0.055f) * 0.9478672986f, 2.4f);

	y = x > 0.04045f ? y : x * 0.0773993808f;
	return M_FLOAT(M_BITS(y) | (M_BITS(display) & 0x80000000u));
}

/* And back. */
static inline float encode_display(float linear)
{
	float x = M_FLOAT(M_BITS(linear) & 0x7fffffffu), large = x < 1.0e14f ? x : 1.0e14f;
	float y = 1.055f * encode_power(large > 0.0031308f ? large : 1.0f, 0.4166666667f) - 0.055f;

	y = x > 0.0031308f ? y : x * 12.92f;
	return M_FLOAT(M_BITS(y) | (M_BITS(linear) & 0x80000000u));
}
