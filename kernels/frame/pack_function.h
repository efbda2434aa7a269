/* What gl/functions.h has, for sixteen numbers at once: the same operations in the same order, to the same bits. OpenCL
 * C only. */
#pragma once

#include "kernels/frame/pack.h"
#include "kernels/gl/functions.h"

WIDE_VECTORS static inline packf pack_function_turn(packf a, uint is_cosine)
{
	const packf far = fabs(a), eighths = far * TURN_EIGHTHS;
	const packu next = select((packu)(0x80000000u), convert_uint16(eighths), as_uint16(eighths < 2147483648.0f)) +
	                   1u,
		    whole = next & ~1u;
	const packf n = select(convert_float16(whole), (packf)(-2147483648.0f), as_int16(whole));
	const packf x = fma(n, (packf)(TURN_PART2), fma(n, (packf)(TURN_PART1), fma(n, (packf)(TURN_PART0), far))), z = x * x;
	const packf sine = fma(fma(fma(z, (packf)(TURN_SINE0), (packf)(TURN_SINE1)), z, (packf)(TURN_SINE2)) * z, x, x);
	const packf cosine = (fma(fma(z, (packf)(TURN_COSINE0), (packf)(TURN_COSINE1)), z, (packf)(TURN_COSINE2)) * z *
	                              z -
	                      z * 0.5f) +
	                     1.0f;
	const packu from = is_cosine ? whole - 2u : whole;
	const packu sign = (is_cosine ? ~from << 29 : as_uint16(a) ^ (next << 29)) & 0x80000000u;
	const packf v = as_float16(as_uint16(select(sine, cosine, as_int16(from << 30))) ^ sign);

	return select((packf)(FUNCTION_NAN), fmin(fmax(v, -1.0f), 1.0f), far < INFINITY);
}

WIDE_VECTORS static inline packf pack_function_exp2(packf a)
{
	const packf least = select(a, (packf)(FUNCTION_LEAST_EXPONENT), a < FUNCTION_LEAST_EXPONENT);
	const packf x = select(least, (packf)(FUNCTION_MOST_EXPONENT), a > FUNCTION_MOST_EXPONENT), whole = floor(x),
		    f = x - whole, z = f * f;
	const packf even = fma(z, fma(z, (packf)(EXP2_FACTOR4), (packf)(EXP2_FACTOR2)), (packf)(1.0f));
	const packf odd = fma(z, fma(z, (packf)(EXP2_FACTOR5), (packf)(EXP2_FACTOR3)), (packf)(EXP2_FACTOR1));

	return select(a, as_float16((convert_int16(whole) + 127) << 23) * fma(odd, f, even), x == x);
}

WIDE_VECTORS static inline packf pack_function_log2(packf a)
{
	const packu bits = as_uint16(a), exponent = bits & 0x7f800000u;
	const packf mantissa = as_float16((bits & 0x7fffffu) | 0x3f800000u), y = (mantissa - 1.0f) / (mantissa + 1.0f),
		    z = y * y, w = z * z;
	const packf even = fma(w, fma(w, (packf)(LOG2_FACTOR4), (packf)(LOG2_FACTOR2)), (packf)(LOG2_FACTOR0));
	const packf odd = fma(w, (packf)(LOG2_FACTOR3), (packf)(LOG2_FACTOR1));
	const packf v = fma(y, fma(odd, z, even), convert_float16(convert_int16(exponent >> 23) - 127));

	return select(select((packf)(FUNCTION_NAN), select(a, v, a < INFINITY), a > 0.0f), (packf)(-INFINITY), exponent == 0u);
}

WIDE_VECTORS static inline packf pack_function_power(packf a, packf b)
{
	return select(pack_function_exp2(pack_function_log2(a) * b), (packf)(0.0f), (as_uint16(a) & 0x7f800000u) == 0u);
}
