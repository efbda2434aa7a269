/* Arithmetic with vectors (one_lanes.h). */

LANES VEC3 v3_add(VEC3 a, VEC3 b)
{
	return V3(a.x + b.x, a.y + b.y, a.z + b.z);
}

LANES VEC3 v3_sub(VEC3 a, VEC3 b)
{
	return V3(a.x - b.x, a.y - b.y, a.z - b.z);
}

LANES VEC3 v3_mul(VEC3 a, VEC3 b)
{
	return V3(a.x * b.x, a.y * b.y, a.z * b.z);
}

LANES REAL v3_most(VEC3 a)
{
	return M_MAX(M_MAX(a.x, a.y), a.z);
}

/* The largest absolute coordinate. */
LANES REAL v3_extent(VEC3 a)
{
	return MOST(MOST(M_ABS(a.x), M_ABS(a.y)), M_ABS(a.z));
}

LANES VEC3 v3_scale(VEC3 a, REAL s)
{
	return V3(a.x * s, a.y * s, a.z * s);
}

LANES REAL v3_dot(VEC3 a, VEC3 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

LANES VEC3 v3_cross(VEC3 a, VEC3 b)
{
	return V3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Scale to length 1; a vector of length 0 is returned unchanged. */
LANES VEC3 v3_normalize(VEC3 a)
{
	REAL length2 = v3_dot(a, a);

	return CHOOSE3(length2 > 0.0f, v3_scale(a, 1.0f / M_SQRT(length2)), a);
}

LANES VEC4 v4_add(VEC4 a, VEC4 b)
{
	return V4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
}

LANES VEC4 v4_sub(VEC4 a, VEC4 b)
{
	return V4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w);
}

LANES VEC4 v4_mul(VEC4 a, VEC4 b)
{
	return V4(a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w);
}

LANES VEC4 v4_scale(VEC4 a, REAL s)
{
	return V4(a.x * s, a.y * s, a.z * s, a.w * s);
}

LANES REAL v4_dot(VEC4 a, VEC4 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

/* a + (b - a) t, so that t = 0 gives exactly a, and equal ends give exactly their value */
LANES VEC4 v4_mix(VEC4 a, VEC4 b, REAL t)
{
	return v4_add(a, v4_scale(v4_sub(b, a), t));
}

/* Interpolate three values by their weights; equal values are returned exactly. */
LANES VEC4 v4_between(VEC4 a, VEC4 b, VEC4 c, const REAL *weight)
{
	return v4_add(a, v4_add(v4_scale(v4_sub(b, a), weight[1]), v4_scale(v4_sub(c, a), weight[2])));
}

LANES REAL clamp01(REAL x)
{
	return CHOOSE(x > 0.0f, CHOOSE(x < 1.0f, x, SAME(1.0f)), SAME(0.0f)); /* a NaN becomes 0 */
}

LANES VEC4 v4_clamp01(VEC4 a)
{
	return V4(clamp01(a.x), clamp01(a.y), clamp01(a.z), clamp01(a.w));
}

/* Clamp as llvmpipe clamps vertex colours: a NaN becomes 1. */
LANES REAL clamp_vertex(REAL x)
{
	return clamp01(CHOOSE(x < 1.0f, x, SAME(1.0f)));
}

LANES VEC4 v4_clamp_vertex(VEC4 a)
{
	return V4(clamp_vertex(a.x), clamp_vertex(a.y), clamp_vertex(a.z), clamp_vertex(a.w));
}

/* Column-major matrix times column vector, summed column by column as Mesa's vertex programs do. */
LANES VEC4 m4_mul(GLOBAL const float *m, VEC4 v)
{
	return V4(m[0] * v.x + m[4] * v.y + m[8] * v.z + m[12] * v.w,
	          m[1] * v.x + m[5] * v.y + m[9] * v.z + m[13] * v.w,
	          m[2] * v.x + m[6] * v.y + m[10] * v.z + m[14] * v.w,
	          m[3] * v.x + m[7] * v.y + m[11] * v.z + m[15] * v.w);
}
