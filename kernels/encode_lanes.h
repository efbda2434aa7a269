/* sRGB's transfer function in both directions (encode.h, one_lanes.h). */

/*
 * x^exponent for 1e-30 < x < 1e15 and exponents up to 2.4, with a relative error of 5e-7: log2 of the mantissa by its
 * series in (m - 1) / (m + 1), times the exponent, then 2 to that power by its own series.
 */
LANES REAL encode_power(REAL x, float exponent)
{
	WORD bits = BITS(x) - 0x3f3504f3u; /* mantissas from 1/sqrt(2) to sqrt(2) */
	REAL m = OF_BITS((bits & 0x7fffffu) + 0x3f3504f3u), e = TO_REAL(AS_INT(bits) >> 23);
	REAL s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
	REAL log2m = s * (2.885390082f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * 0.412198583f)));
	REAL up = exponent * (e + log2m) + 12582912.0f, whole = up - 12582912.0f; /* adding 1.5 x 2^23 rounds */
	REAL f = (exponent * e - whole) + exponent * log2m;
	REAL p = 1.0f + f * (0.6931471806f + f * (0.2402265070f + f * (0.0555041087f + f * (0.0096181291f +
	         f * (0.0013333558f + f * 0.0001540353f)))));

	return p * OF_BITS((BITS(up) - 0x4b400000u + 127u) << 23);
}

/* Display-referred to linear light; an odd function. */
LANES REAL encode_linear(REAL display)
{
	REAL x = OF_BITS(BITS(display) & 0x7fffffffu), large = CHOOSE(x < 1.0e15f, x, SAME(1.0e15f));
	REAL y = encode_power((large + 0.055f) * 0.9478672986f, 2.4f);

	y = CHOOSE(x > 0.04045f, y, x * 0.0773993808f);
	return OF_BITS(BITS(y) | (BITS(display) & 0x80000000u));
}

/* Linear light to display-referred. */
LANES REAL encode_display(REAL linear)
{
	REAL x = OF_BITS(BITS(linear) & 0x7fffffffu), large = CHOOSE(x < 1.0e14f, x, SAME(1.0e14f));
	REAL y = 1.055f * encode_power(CHOOSE(large > 0.0031308f, large, SAME(1.0f)), 0.4166666667f) - 0.055f;

	y = CHOOSE(x > 0.0031308f, y, x * 12.92f);
	return OF_BITS(BITS(y) | (BITS(linear) & 0x80000000u));
}

/* A GL colour as light, if the transport works in linear light. */
LANES VEC3 stage_light(uint32_t transport, VEC3 c)
{
	return transport == TRANSPORT_LINEAR ? V3(encode_linear(c.x), encode_linear(c.y), encode_linear(c.z)) : c;
}

/* The inverse: light as the number that OpenGL's per-fragment operations expect. */
LANES VEC3 stage_number(uint32_t transport, VEC3 c)
{
	return transport == TRANSPORT_LINEAR ? V3(encode_display(c.x), encode_display(c.y), encode_display(c.z)) : c;
}
