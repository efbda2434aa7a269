/* The end of GL's fragment stage (fragment.h, one_lanes.h). All lanes share one material. */

/* Linear fog (sec. 3.10). The specification does not define fog of zero length; Mesa (22.3.6) uses c - end. */
LANES REAL fog_linear(GLOBAL const struct scene_material *m, REAL c)
{
	return clamp01(m->fog_end == m->fog_start ? c - m->fog_end : (m->fog_end - c) / (m->fog_end - m->fog_start));
}

/*
 * Texture environments, colour sum and fog applied to a lit colour. The result is clamped once at the end, as in Mesa
 * (22.3.6), where sec. 3.9 clamps the sum before the fog. sample: indexed by GL's unit number; fog: 1 leaves the colour
 * without fog; without: 1 + the index of a unit to skip; 0: none
 */
LANES VEC4 finish_in_fog(const struct tables *t, GLOBAL const struct scene_material *m, const VEC4 *sample,
                         const struct LANED(lit) *lit, REAL fog, uint32_t without)
{
	VEC4 color = lit->color;

	for (uint32_t i = 0u; i < m->unit_count; i++) {
		GLOBAL const struct scene_unit *unit = &t->units[m->unit_first + i];
		const VEC4 s = sample[unit->unit];

		if (unit->unit + 1u == without)
			continue;
		color = unit->env_mode == GL_COMBINE || unit->env_mode == GL_COMBINE4_NV ?
		                combine_full(unit, color, s, lit->color, sample) :
		                combine_plain(unit->env_mode, point_unit_format(t, unit), color, s, SAME4(v4_load(unit->env_color)));
	}
	if (m->color_sum || (m->lighting && m->separate_specular))
		color = V4(color.x + lit->secondary.x, color.y + lit->secondary.y, color.z + lit->secondary.z, color.w);
	if (m->fog)
		color = V4(color.x * fog + m->fog_color[0] * (1.0f - fog), color.y * fog + m->fog_color[1] * (1.0f - fog),
		           color.z * fog + m->fog_color[2] * (1.0f - fog), color.w);
	return m->unclamped & 1u ? color : v4_clamp01(color);
}
