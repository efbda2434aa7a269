/* 8-bit blending (blend.h, one_lanes.h). */

/* A channel in 1/255, clamped and rounded. */
LANES WORD blend_round(REAL x)
{
	return AS_WORD(TO_INT(ROUND(clamp01(x) * 255.0f)));
}

/* The product of two numbers in 1/255, rounded. Both products of a sum are rounded before they are added. */
LANES WORD blend_multiply(WORD a, WORD b)
{
	WORD ab = a * b;

	return (ab + (ab >> 8) + 128u) >> 8;
}

/* Operands of blend factors: one channel of the source, destination and constant colour, and their alphas. */
struct LANED(blend8) {
	WORD s, s_alpha, d, d_alpha; /* 0 to 255 */
	REAL c, c_alpha;             /* not rounded yet: few factors use them */
	MASK is_alpha;               /* the channel is alpha itself */
};

/* A factor's value for one channel (table 4.2). */
LANES WORD blend_factor(uint32_t factor, const struct LANED(blend8) *of)
{
	switch (factor) {
	case GL_ZERO: return (WORD)(0u);
	case GL_SRC_COLOR: return of->s;
	case GL_ONE_MINUS_SRC_COLOR: return 255u - of->s;
	case GL_DST_COLOR: return of->d;
	case GL_ONE_MINUS_DST_COLOR: return 255u - of->d;
	case GL_SRC_ALPHA: return of->s_alpha;
	case GL_ONE_MINUS_SRC_ALPHA: return 255u - of->s_alpha;
	case GL_DST_ALPHA: return of->d_alpha;
	case GL_ONE_MINUS_DST_ALPHA: return 255u - of->d_alpha;
	case GL_CONSTANT_COLOR: return blend_round(of->c);
	case GL_ONE_MINUS_CONSTANT_COLOR: return 255u - blend_round(of->c);
	case GL_CONSTANT_ALPHA: return blend_round(of->c_alpha);
	case GL_ONE_MINUS_CONSTANT_ALPHA: return 255u - blend_round(of->c_alpha);
	case GL_SRC_ALPHA_SATURATE:
		return CHOOSE(of->is_alpha, (WORD)(255u),
		              CHOOSE(of->s_alpha < 255u - of->d_alpha, of->s_alpha, 255u - of->d_alpha));
	default: return (WORD)(255u);
	}
}

/* One channel by a blend equation (table 4.1), clamped. fs, fd: factors of s and d, which GL_MIN and GL_MAX ignore */
LANES WORD blend_equation(uint32_t equation, WORD s, WORD fs, WORD d, WORD fd)
{
	WORD a = blend_multiply(s, fs), b = blend_multiply(d, fd);

	switch (equation) {
	case GL_FUNC_SUBTRACT: return CHOOSE(a > b, a - b, (WORD)(0u));
	case GL_FUNC_REVERSE_SUBTRACT: return CHOOSE(b > a, b - a, (WORD)(0u));
	case GL_MIN: return CHOOSE(s < d, s, d);
	case GL_MAX: return CHOOSE(s > d, s, d);
	default: return CHOOSE(a + b < 255u, a + b, (WORD)(255u));
	}
}

/* Blend a channel of a source colour over a destination, by a material's factors and equations. */
LANES REAL blend_channel(GLOBAL const struct scene_material *m, int channel, REAL source, WORD s_alpha,
                         REAL destination, WORD d_alpha)
{
	const int is_alpha = channel == 3;
	struct LANED(blend8) of;

	of.s = blend_round(source);
	of.s_alpha = s_alpha;
	of.d = blend_round(destination);
	of.d_alpha = d_alpha;
	of.c = SAME(m->blend_color[channel]);
	of.c_alpha = SAME(m->blend_color[3]);
	of.is_alpha = IF_ALL(is_alpha);
	return TO_REAL(AS_INT(blend_equation(is_alpha ? m->blend_equation_alpha : m->blend_equation_rgb, of.s,
	                                     blend_factor(is_alpha ? m->blend_src_alpha : m->blend_src_rgb, &of), of.d,
	                                     blend_factor(is_alpha ? m->blend_dst_alpha : m->blend_dst_rgb, &of)))) /
	       255.0f;
}
