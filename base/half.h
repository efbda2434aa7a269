/* 16-bit floats: sign, 5 bits of exponent, 10 of mantissa (IEEE 754 binary16). */
#pragma once

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
