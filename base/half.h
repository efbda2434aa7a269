/* Numbers of 16 bits: sign, 5 bits of exponent, 10 of mantissa (IEEE 754 binary16). */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

/** The float of the same value; NaNs keep their sign and payload. */
static inline float half_to_float(uint16_t h)
{
	uint32_t sign = (uint32_t)(h & 0x8000) << 16, exponent = h >> 10 & 31, mantissa = h & 1023, bits;
	float f;

	if (exponent == 0) {
		f = (float)mantissa / 16777216.0f;
		return sign ? -f : f;
	}
	bits = sign | (exponent == 31 ? 0x7f800000u : (exponent + 112) << 23) | mantissa << 13;
	memcpy(&f, &bits, 4);
	return f;
}

/** The nearest of them, the even one of two; too large a number is infinite. */
static inline uint16_t half_of_float(float f)
{
	uint32_t bits, sign;

	memcpy(&bits, &f, 4);
	sign = bits >> 16 & 0x8000;
	bits &= 0x7fffffff;
	if (bits > 0x7f800000)
		return (uint16_t)(sign | 0x7e00);
	if (bits >= 0x477ff000)
		return (uint16_t)(sign | 0x7c00);
	if (bits < 0x38800000)
		return (uint16_t)(sign | (uint32_t)lrintf(fabsf(f) * 16777216.0f));
	bits += 0xfff + (bits >> 13 & 1);
	return (uint16_t)(sign | (bits - 0x38000000) >> 13);
}
