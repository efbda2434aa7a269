/* Numbers of textures (texture.h, one_lanes.h). */

/* Convert a coordinate to an integer; it may have any value, even NaN. */
LANES INT texture_int(REAL x)
{
	return TO_INT(CHOOSE(x > -1.0e9f, CHOOSE(x < 1.0e9f, x, SAME(1.0e9f)), SAME(-1.0e9f)));
}

/* Interpolate four channels at once. weight: of b, 0 to 255 for [0,1) */
LANES WORD texture_mix_8(WORD a, WORD b, WORD weight)
{
	WORD even = (a & 0xff00ffu) * (256u - weight) + (b & 0xff00ffu) * weight + 0x800080u;
	WORD odd = (a >> 8 & 0xff00ffu) * (256u - weight) + (b >> 8 & 0xff00ffu) * weight + 0x800080u;

	return (even >> 8 & 0xff00ffu) | (odd & 0xff00ff00u);
}

/*
 * log2 of a squared number of texels, halved: llvmpipe's logarithm, which is exact at powers of two and linear between.
 */
LANES REAL texture_half_log2(REAL rho2)
{
	const WORD bits = BITS(rho2);
	const REAL between = 0.5f * (TO_REAL(AS_INT(bits >> 23) - 127) + (OF_BITS((bits & 0x7fffffu) | 0x3f800000u) - 1.0f));

	return CHOOSE(rho2 > 1.0e-30f, CHOOSE(rho2 < 1.0e30f, between, SAME(100.0f)), SAME(-100.0f));
}
