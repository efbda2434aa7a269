/* Sixteen of OpenGL's numbers as light and back, as encode.h has one. OpenCL C only. */
#pragma once

#include "kernels/encode.h"
#include "kernels/rays/gather.h"

/* As encode_power. */
WIDE_VECTORS static inline packf pack_power(packf x, float exponent)
{
	const packu bits = as_uint16(x) - 0x3f3504f3u;
	const packf m = as_float16((bits & 0x7fffffu) + 0x3f3504f3u), e = convert_float16(as_int16(bits) >> 23);
	const packf s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
	const packf log2m = s * (2.885390082f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * 0.412198583f)));
	const packf up = exponent * (e + log2m) + 12582912.0f, whole = up - 12582912.0f;
	const packf f = (exponent * e - whole) + exponent * log2m;
	const packf p = 1.0f + f * (0.6931471806f + f * (0.2402265070f + f * (0.0555041087f + f * (0.0096181291f +
	                f * (0.0013333558f + f * 0.0001540353f)))));

	return p * as_float16((as_uint16(up) - 0x4b400000u + 127u) << 23);
}

/* A number that is not below 0, with the sign of another. */
WIDE_VECTORS static inline packf pack_signed(packf x, packf sign)
{
	return as_float16(as_uint16(x) | (as_uint16(sign) & 0x80000000u));
}

/* As encode_linear. */
WIDE_VECTORS static inline packf pack_linear(packf display)
{
	const packf x = fabs(display), large = select((packf)(1.0e15f), x, x < 1.0e15f);
	const packf y = pack_power((large + 0.055f) * 0.9478672986f, 2.4f);

	return pack_signed(select(x * 0.0773993808f, y, x > 0.04045f), display);
}

/* Of three at once, which overlap: each is a long chain of steps. */
WIDE_VECTORS static inline void pack_linear3(packf *c)
{
	const packf first = pack_linear(c[0]), second = pack_linear(c[1]), third = pack_linear(c[2]);

	c[0] = first;
	c[1] = second;
	c[2] = third;
}

/* As encode_display. */
WIDE_VECTORS static inline packf pack_display(packf linear)
{
	const packf x = fabs(linear), large = select((packf)(1.0e14f), x, x < 1.0e14f);
	const packf y = 1.055f * pack_power(select((packf)(1.0f), large, large > 0.0031308f), 0.4166666667f) - 0.055f;

	return pack_signed(select(x * 12.92f, y, x > 0.0031308f), linear);
}

/* As stage_light. */
WIDE_VECTORS static inline packf pack_as_light(uint transport, packf c)
{
	return transport == TRANSPORT_LINEAR ? pack_linear(c) : c;
}

/* As stage_number. */
WIDE_VECTORS static inline packf pack_as_number(uint transport, packf c)
{
	return transport == TRANSPORT_LINEAR ? pack_display(c) : c;
}
