/* Texture environments and combiners (combine.h, one_lanes.h). All lanes share one unit. */

/* The environments of tables 3.22 and 3.23; p: previous, s: texture, e: the unit's colour. */
LANES VEC4 combine_plain(uint32_t mode, uint32_t format, VEC4 p, VEC4 s, VEC4 e)
{
	VEC4 out = p;

	if (mode == GL_DECAL) {
		REAL a = format == GL_RGBA ? s.w : SAME(1.0f);

		if (format == GL_RGB || format == GL_RGBA || format == GL_RED || format == GL_RG)
			out = V4(p.x * (1.0f - a) + s.x * a, p.y * (1.0f - a) + s.y * a, p.z * (1.0f - a) + s.z * a, p.w);
		return out;
	}
	if (combine_has_color(format)) {
		switch (mode) {
		case GL_REPLACE:
			out = V4(s.x, s.y, s.z, out.w);
			break;
		case GL_BLEND:
			out = V4(p.x * (1.0f - s.x) + e.x * s.x, p.y * (1.0f - s.y) + e.y * s.y,
			         p.z * (1.0f - s.z) + e.z * s.z, out.w);
			break;
		case GL_ADD:
			out = V4(p.x + s.x, p.y + s.y, p.z + s.z, out.w);
			break;
		default: /* MODULATE */
			out = V4(p.x * s.x, p.y * s.y, p.z * s.z, out.w);
			break;
		}
	}
	if (combine_has_alpha(format)) {
		if (mode == GL_REPLACE)
			out.w = s.w;
		else if (mode == GL_BLEND && format == GL_INTENSITY)
			out.w = p.w * (1.0f - s.w) + e.w * s.w;
		else if (mode == GL_ADD && format == GL_INTENSITY)
			out.w = p.w + s.w;
		else
			out.w = p.w * s.w;
	}
	return mode == GL_ADD ? v4_clamp01(out) : out;
}

/* One argument; `alpha` selects the input of the alpha equation (w of the result). samples: of all enabled units. */
LANES VEC4 combine_argument(uint32_t source, uint32_t operand, VEC4 previous, VEC4 texture, VEC4 primary, VEC4 own,
                            const VEC4 *samples)
{
	VEC4 a = previous;

	if (source == GL_TEXTURE)
		a = texture;
	else if (source == GL_PRIMARY_COLOR)
		a = primary;
	else if (source == GL_CONSTANT)
		a = own;
	else if (source == GL_ZERO)
		a = SAME4(v4(0.0f, 0.0f, 0.0f, 0.0f));
	else if (source == GL_ONE)
		a = SAME4(v4(1.0f, 1.0f, 1.0f, 1.0f));
	else if (source >= GL_TEXTURE0 && source < GL_TEXTURE0 + SCENE_MAX_UNITS)
		a = samples[source - GL_TEXTURE0];
	if (operand == GL_SRC_ALPHA || operand == GL_ONE_MINUS_SRC_ALPHA)
		a = V4(a.w, a.w, a.w, a.w);
	if (operand == GL_ONE_MINUS_SRC_COLOR || operand == GL_ONE_MINUS_SRC_ALPHA)
		a = V4(1.0f - a.x, 1.0f - a.y, 1.0f - a.z, 1.0f - a.w);
	return a;
}

LANES VEC4 combine_function(uint32_t function, VEC4 a, VEC4 b, VEC4 c)
{
	VEC4 half4 = SAME4(v4(0.5f, 0.5f, 0.5f, 0.5f));
	REAL dot;

	switch (function) {
	case GL_REPLACE:
		return a;
	case GL_ADD:
		return v4_add(a, b);
	case GL_ADD_SIGNED:
		return v4_sub(v4_add(a, b), half4);
	case GL_INTERPOLATE:
		return v4_add(v4_mul(a, c), v4_mul(b, V4(1.0f - c.x, 1.0f - c.y, 1.0f - c.z, 1.0f - c.w)));
	case GL_SUBTRACT:
		return v4_sub(a, b);
	case GL_DOT3_RGB:
	case GL_DOT3_RGBA:
	case GL_DOT3_RGB_EXT:
	case GL_DOT3_RGBA_EXT:
		dot = 4.0f * ((a.x - 0.5f) * (b.x - 0.5f) + (a.y - 0.5f) * (b.y - 0.5f) + (a.z - 0.5f) * (b.z - 0.5f));
		return V4(dot, dot, dot, dot);
	case GL_MODULATE_ADD_ATI:
		return v4_add(v4_mul(a, c), b);
	case GL_MODULATE_SIGNED_ADD_ATI:
		return v4_sub(v4_add(v4_mul(a, c), b), half4);
	case GL_MODULATE_SUBTRACT_ATI:
		return v4_sub(v4_mul(a, c), b);
	default: /* MODULATE */
		return v4_mul(a, b);
	}
}

/* In NV_texture_env_combine4, sums have two products; its other functions are those of COMBINE. */
LANES VEC4 combine_function4(uint32_t function, const VEC4 *arguments)
{
	if (function != GL_ADD && function != GL_ADD_SIGNED)
		return combine_function(function, arguments[0], arguments[1], arguments[2]);
	return combine_function(function, v4_mul(arguments[0], arguments[1]), v4_mul(arguments[2], arguments[3]),
	                        arguments[2]);
}

/* Scaled and clamped; the dot products of EXT_texture_env_dot3 are not scaled. */
LANES VEC4 combine_scaled(VEC4 color, uint32_t function, float scale)
{
	if (function == GL_DOT3_RGB_EXT || function == GL_DOT3_RGBA_EXT)
		scale = 1.0f;
	color = v4_scale(color, SAME(scale));
	return combine_leaves_range(function) || scale != 1.0f ? v4_clamp01(color) : color;
}

/* DOT3_RGBA also produces alpha, which nevertheless has its own scale. */
LANES VEC4 combine_full(GLOBAL const struct scene_unit *unit, VEC4 previous, VEC4 texture, VEC4 primary,
                        const VEC4 *samples)
{
	int four = unit->env_mode == GL_COMBINE4_NV, n = four ? 4 : 3;
	int rgba = unit->combine_rgb == GL_DOT3_RGBA || unit->combine_rgb == GL_DOT3_RGBA_EXT;
	VEC4 own = SAME4(v4_load(unit->env_color)), rgb[4], alpha[4], color, out;

	for (int i = 0; i < n; i++) {
		rgb[i] = combine_argument(unit->source_rgb[i], unit->operand_rgb[i], previous, texture, primary, own,
		                          samples);
		alpha[i] = combine_argument(unit->source_alpha[i], unit->operand_alpha[i], previous, texture, primary,
		                            own, samples);
	}
	color = four ? combine_function4(unit->combine_rgb, rgb) : combine_function(unit->combine_rgb, rgb[0], rgb[1], rgb[2]);
	out = four ? combine_function4(unit->combine_alpha, alpha) :
	             combine_function(unit->combine_alpha, alpha[0], alpha[1], alpha[2]);
	out = rgba ? combine_scaled(color, unit->combine_rgb, unit->scale_alpha) :
	             combine_scaled(out, unit->combine_alpha, unit->scale_alpha);
	color = combine_scaled(color, unit->combine_rgb, unit->scale_rgb);
	return V4(color.x, color.y, color.z, out.w);
}
