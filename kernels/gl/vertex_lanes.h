/* Formulas of the vertex stage (vertex.h, one_lanes.h). */

/*
 * A colour without lighting, clamped (sec. 2.14.6). The specification leaves NaN open: llvmpipe makes it 1 if vertices
 * carry the colour, and 0 if it is the current colour.
 */
LANES VEC4 vertex_clamp(VEC4 c, uint32_t per_vertex)
{
	return per_vertex ? v4_clamp_vertex(c) : v4_clamp01(c);
}

/* A normal in eye space, of any length. r: normal_matrix of struct geometry */
LANES VEC3 vertex_turn_normal(GLOBAL const float *r, VEC3 n)
{
	return V3(r[0] * n.x + r[1] * n.y + r[2] * n.z, r[4] * n.x + r[5] * n.y + r[6] * n.z,
	          r[8] * n.x + r[9] * n.y + r[10] * n.z);
}

/* Fog distance of a vertex in eye space (NV_fog_distance); squares are summed as in Mesa's dot products. */
LANES REAL vertex_fog_distance(uint32_t source, VEC4 eye)
{
	if (source == GL_EYE_RADIAL_NV)
		return M_SQRT(eye.z * eye.z + eye.y * eye.y + eye.x * eye.x);
	return source == GL_EYE_PLANE ? eye.z : M_ABS(eye.z);
}

/*
 * Size of a point after attenuation (sec. 3.3), before it is rounded to pixels. The distance is the depth alone, as in
 * Mesa (22.3.6, build_atten_pointsize).
 */
LANES REAL vertex_point_size(GLOBAL const struct scene_material *m, VEC4 eye)
{
	REAL d = M_ABS(eye.z), fade = m->point_attenuation[0] + d * (m->point_attenuation[1] + d * m->point_attenuation[2]);
	REAL size = CHOOSE(fade != 1.0f && fade > 0.0f, m->point_size * M_SQRT(1.0f / fade), SAME(m->point_size));

	return LEAST(MOST(size, SAME(m->point_size_min)), SAME(m->point_size_max));
}
