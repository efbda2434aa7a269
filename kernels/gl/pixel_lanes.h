/* Comparisons, depths and colours of per-fragment operations (pixel.h, one_lanes.h). */

LANES MASK pixel_compare(uint32_t func, WORD a, WORD b)
{
	switch (func) {
	case GL_NEVER: return IF_ALL(0);
	case GL_LESS: return a < b;
	case GL_EQUAL: return a == b;
	case GL_LEQUAL: return a <= b;
	case GL_GREATER: return a > b;
	case GL_NOTEQUAL: return a != b;
	case GL_GEQUAL: return a >= b;
	default: return IF_ALL(1);
	}
}

/*
 * Depth as a buffer with `bits` bits stores it, rounded to even as in Mesa. With more than 24 bits it keeps the float's
 * own bits: the last bit is always 0, except that 1 has all bits set.
 */
LANES WORD pixel_depth_steps(REAL depth, uint32_t bits)
{
	depth = clamp01(depth);
	if (bits > 24u)
		return CHOOSE(depth < 1.0f, TO_WORD(depth * 2147483648.0f) << 1, (WORD)(0xffffffffu));
	return TO_WORD(ROUND(depth * (float)pixel_bits_mask(bits)));
}

/*
 * Moves a number off the border between two 8-bit codes by at most 0.04 codes, to the side that the frame buffer rounds
 * to, so that a picture's half floats and encoding cannot change its code. For example, 0.3 is 76.5, and 76 in Mesa.
 */
LANES REAL pixel_nudge(REAL x)
{
	REAL codes = clamp01(x) * 255.0f, code = ROUND(codes), rest = codes - code;

	return CHOOSE(M_ABS(rest) > 0.46f, (code + CHOOSE(rest > 0.0f, SAME(0.46f), SAME(-0.46f))) / 255.0f, x);
}
