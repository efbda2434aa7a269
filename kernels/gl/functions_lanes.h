/* Functions of programs (functions.h, one_lanes.h). */

LANES REAL function_turn(REAL a, uint32_t is_cosine)
{
	const REAL far = M_ABS(a), eighths = far * TURN_EIGHTHS;
	const WORD next = CHOOSE(eighths < 2147483648.0f, TO_WORD(eighths), (WORD)(0x80000000u)) + 1u, whole = next & ~1u;
	const REAL n = CHOOSE(AS_INT(whole) < 0, SAME(-2147483648.0f), TO_REAL(whole));
	const REAL near = M_FMA(n, SAME(TURN_PART1), M_FMA(n, SAME(TURN_PART0), far));
	const REAL x = M_FMA(n, SAME(TURN_PART2), near), z = x * x;
	const REAL odd = M_FMA(M_FMA(z, SAME(TURN_SINE0), SAME(TURN_SINE1)), z, SAME(TURN_SINE2));
	const REAL even = M_FMA(M_FMA(z, SAME(TURN_COSINE0), SAME(TURN_COSINE1)), z, SAME(TURN_COSINE2));
	const REAL sine = M_FMA(odd * z, x, x), cosine = (even * z * z - z * 0.5f) + 1.0f;
	const WORD from = is_cosine ? whole - 2u : whole;
	const WORD sign = (is_cosine ? ~from << 29 : BITS(a) ^ (next << 29)) & 0x80000000u;
	const REAL v = OF_BITS(BITS(CHOOSE((from & 2u) != 0u, cosine, sine)) ^ sign);

	return CHOOSE(far < INFINITY, M_MIN(M_MAX(v, SAME(-1.0f)), SAME(1.0f)), SAME(FUNCTION_NAN));
}

LANES REAL function_exp2(REAL a)
{
	const REAL least = CHOOSE(a < FUNCTION_LEAST_EXPONENT, SAME(FUNCTION_LEAST_EXPONENT), a);
	const REAL x = CHOOSE(a > FUNCTION_MOST_EXPONENT, SAME(FUNCTION_MOST_EXPONENT), least);
	const REAL whole = M_FLOOR(x), f = x - whole, z = f * f;
	const REAL even = M_FMA(z, M_FMA(z, SAME(EXP2_FACTOR4), SAME(EXP2_FACTOR2)), SAME(1.0f));
	const REAL odd = M_FMA(z, M_FMA(z, SAME(EXP2_FACTOR5), SAME(EXP2_FACTOR3)), SAME(EXP2_FACTOR1));

	return CHOOSE(x == x, OF_BITS(AS_WORD(TO_INT(whole) + 127) << 23) * M_FMA(odd, f, even), a);
}

/* Subnormal values count as 0, as llvmpipe sets the processor to treat them. */
LANES REAL function_log2(REAL a)
{
	const WORD bits = BITS(a), exponent = bits & 0x7f800000u;
	const REAL mantissa = OF_BITS((bits & 0x7fffffu) | 0x3f800000u), y = (mantissa - 1.0f) / (mantissa + 1.0f);
	const REAL z = y * y, w = z * z, whole = TO_REAL(AS_INT(exponent >> 23) - 127);
	const REAL even = M_FMA(w, M_FMA(w, SAME(LOG2_FACTOR4), SAME(LOG2_FACTOR2)), SAME(LOG2_FACTOR0));
	const REAL odd = M_FMA(w, SAME(LOG2_FACTOR3), SAME(LOG2_FACTOR1)), v = M_FMA(y, M_FMA(odd, z, even), whole);

	return CHOOSE(exponent == 0u, SAME(-INFINITY), CHOOSE(a > 0.0f, CHOOSE(a < INFINITY, v, a), SAME(FUNCTION_NAN)));
}

/* 0 to any power is 0, even 0 to the power of 0 (lp_build_pow); subnormal values count as 0. */
LANES REAL function_power(REAL a, REAL b)
{
	return CHOOSE((BITS(a) & 0x7f800000u) == 0u, SAME(0.0f), function_exp2(function_log2(a) * b));
}
