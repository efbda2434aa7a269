/* Random numbers, and directions made of them (one_lanes.h). */

/* Hash a number by multiply, shift and xor (constants found by C. Wellons, "Prospecting for hash functions"). */
LANES WORD sample_hash(WORD x)
{
	x ^= x >> 16;
	x *= 0x7feb352du;
	x ^= x >> 15;
	x *= 0x846ca68bu;
	x ^= x >> 16;
	return x;
}

LANES REAL sample_unit(WORD x)
{
	return TO_REAL(x >> 8) * 5.9604644775390625e-8f; /* 2^-24: below 1 */
}

/* The bits of a number in reverse order. */
LANES WORD sample_reverse(WORD x)
{
	x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
	x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
	x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
	x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
	return x >> 16 | x << 16;
}

/* Flip each bit depending on a hash of the bits below it (S. Laine and T. Karras, "Stratified Sampling for Stochastic
 * Transparency", 2011; constants after N. Vegdahl, "Building a Better LK Hash", 2021). */
LANES WORD sample_mix_upwards(WORD x, WORD seed)
{
	x ^= x * 0x3d20adeau;
	x += seed;
	x *= seed >> 16 | 1u;
	x ^= x * 0x05526c56u;
	x ^= x * 0x53a22864u;
	return x;
}

/*
 * Point `index` of Sobol's (0,2)-sequence, with Owen scrambling (A. Owen, "Randomly Permuted (t,m,s)-Nets and
 * (t,s)-Sequences", 1995) and with its points in shuffled order, which makes seeds independent of each other (B.
 * Burley, "Practical Hash-based Owen Scrambling", 2020). Points 0 up to any power of two are evenly distributed.
 */
LANES void sample_sobol(WORD seed, uint32_t index, REAL *u, REAL *v)
{
	const WORD hash = sample_hash(seed);
	const WORD place = sample_reverse(sample_mix_upwards((WORD)(sample_reverse(index)), hash));
	WORD second = place; /* Sobol's matrix of dimension 2, applied by halves; its rows are Pascal's triangle modulo 2 */

	second ^= second >> 16;
	second ^= (second & 0xff00ff00u) >> 8;
	second ^= (second & 0xf0f0f0f0u) >> 4;
	second ^= (second & 0xccccccccu) >> 2;
	second ^= (second & 0xaaaaaaaau) >> 1;
	*u = sample_unit(sample_reverse(sample_mix_upwards(place, sample_hash(hash ^ 0x85ebca6bu))));
	*v = sample_unit(sample_reverse(sample_mix_upwards(second, sample_hash(hash ^ 0xc2b2ae35u))));
}

/* Two unit vectors perpendicular to a unit vector and to each other. */
LANES void sample_basis(VEC3 n, VEC3 *a, VEC3 *b)
{
	const MASK by_x = M_ABS(n.x) < 0.6f;
	const VEC3 other = V3(CHOOSE(by_x, SAME(1.0f), SAME(0.0f)), CHOOSE(by_x, SAME(0.0f), SAME(1.0f)), SAME(0.0f));

	*a = v3_normalize(v3_cross(n, other));
	*b = v3_cross(n, *a);
}
