/* Formulas of the vertex stage (vertex.h, one_lanes.h). */

/*
 * A colour without lighting, clamped (sec. 2.14.6). What the specification leaves open: llvmpipe makes a NaN 1 where
 * vertices carry the colour, and 0 where it is the current one.
 */
LANES VEC4 vertex_clamp(VEC4 c, uint32_t per_vertex)
{
	return per_vertex ? v4_clamp_vertex(c) : v4_clamp01(c);
}
