/* Conversions to the values stored in planes (compose.h, one_lanes.h). */

/* The bits of the nearest half, ties to even; infinity beyond its range. */
LANES WORD compose_half(REAL x)
{
	WORD bits = BITS(x), size = bits & 0x7fffffffu;
	WORD normal = (size - 0x38000000u + 0xfffu + (size >> 13 & 1u)) >> 13;
	WORD small = BITS(OF_BITS(size) + 0.5f) - 0x3f000000u; /* subnormal: adding 0.5 shifts the bits into place */
	WORD odd = CHOOSE(size > 0x7f800000u, (WORD)(0x7e00u), (WORD)(0x7c00u)); /* 65536 and more, infinity, NaN */
	WORD finite = CHOOSE(size < 0x38800000u, small, normal);

	return (bits >> 16 & 0x8000u) | CHOOSE(size < 0x47800000u, finite, odd);
}

/* A number rounded to half precision; up to 65504. */
LANES REAL compose_rounded(REAL x)
{
	WORD bits = BITS(x), size = bits & 0x7fffffffu;
	WORD normal = (size + 0xfffu + (size >> 13 & 1u)) & ~0x1fffu;
	WORD small = BITS((OF_BITS(size) + 0.5f) - 0.5f);

	return OF_BITS((bits & 0x80000000u) | CHOOSE(size < 0x38800000u, small, normal));
}

/* The remainder of a sum, rounded as it is stored. A remainder that is only rounding counts as no effect. */
LANES REAL compose_effect(REAL rest, REAL of)
{
	return CHOOSE(M_ABS(rest) > M_ABS(of) * 0.001953125f, compose_rounded(rest), SAME(0.0f));
}

/*
 * GL's number, moved away from the borders between the frame buffer's 8-bit codes by more than halves and the encoding
 * can change it. Rounding it to 8 bits again then gives the same code as GL's own rounding.
 */
LANES REAL compose_nudged(REAL gl)
{
	REAL steps = gl * 255.0f, code = ROUND(steps);
	REAL moved = (code + CHOOSE(steps > code, SAME(COMPOSE_CODE_REACH), SAME(-COMPOSE_CODE_REACH))) / 255.0f;

	return CHOOSE(gl >= 0.0f && gl <= 1.0f && M_ABS(steps - code) > COMPOSE_CODE_REACH, moved, gl);
}
