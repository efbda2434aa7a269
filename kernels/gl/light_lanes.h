/* GL's lighting of vertices or points (light.h, one_lanes.h). All lanes share one material and the same lights. */

struct LANED(lit) {
	VEC4 color, secondary; /* clamped; secondary is 0 unless the specular colour is separate */
	WORD lights;           /* bit i: light i of the list adds diffuse or specular light, which can be shadowed */
};

/* A vertex or point to light: its colours under white light, and its direction. */
struct LANED(matter) {
	VEC4 ambient, diffuse, specular;
	REAL shininess;
	VEC3 at, normal, to_viewer;
	MASK is_long; /* the normal is too long: a highlight's power may be NaN */
};

/* Spot factor for the unit vector towards the light (equation in sec. 2.14.1). Exactly on the edge of the cone, Mesa
 * (22.3.6) gives no light. */
LANES REAL light_spot(GLOBAL const struct scene_light *light, VEC3 to_light)
{
	const VEC3 axis = SAME3(v3_normalize(v3_load(light->spot_direction_eye)));
	const REAL along = -v3_dot(to_light, axis);
	MASK is_outside;

	if (light->spot_cutoff_deg == 180.0f)
		return SAME(1.0f);
	is_outside = along <= M_MAX(M_COS(light->spot_cutoff_deg * 0.017453292519943295f), 0.0f);
	return CHOOSE(is_outside, SAME(0.0f),
	              light->spot_exponent == 0.0f ? SAME(1.0f) : M_POW(along, SAME(light->spot_exponent)));
}

/* Attenuation of a light at a position, including the spot factor, and the unit vector towards it. */
LANES REAL light_strength(GLOBAL const struct scene_light *light, VEC3 at, VEC3 *to_light)
{
	VEC3 to = SAME3(light_place(light));
	REAL strength = SAME(1.0f), distance;

	if (light->position_eye[3] != 0.0f) {
		to = v3_sub(to, at);
		distance = M_SQRT(v3_dot(to, to));
		/* The distance to a light may overflow, so it must not be used if the attenuation does not need it. */
		strength = light->attenuation[1] == 0.0f && light->attenuation[2] == 0.0f ?
		                   SAME(1.0f / light->attenuation[0]) :
		                   1.0f / (light->attenuation[0] +
		                           distance * (light->attenuation[1] + distance * light->attenuation[2]));
	}
	*to_light = v3_normalize(to);
	return strength * light_spot(light, *to_light);
}

/* A material colour of each side, or the vertices' colour if color material tracks it (sec. 2.14.3). */
LANES VEC4 light_material_color(GLOBAL const float *front, GLOBAL const float *back, MASK is_back, MASK tracked,
                                VEC4 vertex_color)
{
	return CHOOSE4(tracked, vertex_color, CHOOSE4(is_back, SAME4(v4_load(back)), SAME4(v4_load(front))));
}

/*
 * A side's material under white light, without its position.
 *
 * front, back   the material's sides
 * vertex_color  the current colours, for color material
 * out           receives the light that comes from no light source
 */
LANES void light_material(GLOBAL const struct scene_material *m, GLOBAL const struct scene_face *front,
                          GLOBAL const struct scene_face *back, MASK is_back, VEC4 vertex_color,
                          struct LANED(matter) *matter, struct LANED(lit) *out)
{
	const uint32_t mode = m->color_material_mode;
	const MASK none = IF_ALL(0),
		   tracks = CHOOSE(is_back, IF_ALL(m->color_material == GL_BACK || m->color_material == GL_FRONT_AND_BACK),
	                           IF_ALL(m->color_material == GL_FRONT || m->color_material == GL_FRONT_AND_BACK));
	const MASK ambient = mode == GL_AMBIENT || mode == GL_AMBIENT_AND_DIFFUSE ? tracks : none;
	const MASK diffuse = mode == GL_DIFFUSE || mode == GL_AMBIENT_AND_DIFFUSE ? tracks : none;
	const MASK specular = mode == GL_SPECULAR ? tracks : none, emission = mode == GL_EMISSION ? tracks : none;

	matter->ambient = light_material_color(front->ambient, back->ambient, is_back, ambient, vertex_color);
	matter->diffuse = light_material_color(front->diffuse, back->diffuse, is_back, diffuse, vertex_color);
	matter->specular = light_material_color(front->specular, back->specular, is_back, specular, vertex_color);
	matter->shininess = CHOOSE(is_back, SAME(back->shininess), SAME(front->shininess));
	out->color = v4_add(light_material_color(front->emission, back->emission, is_back, emission, vertex_color),
	                    v4_mul(matter->ambient, SAME4(v4_load(m->light_model_ambient))));
}

/* For surfaces that are lit only by rules: only the vertices' colours of the material are used. */
LANES void light_matte(VEC4 vertex_color, struct LANED(matter) *matter, struct LANED(lit) *out)
{
	matter->ambient = matter->diffuse = vertex_color;
	matter->specular = out->color = SAME4(v4(0.0f, 0.0f, 0.0f, 0.0f));
	matter->shininess = SAME(0.0f);
}

/* Before the first light. normal: of the lit side */
LANES void light_begin(GLOBAL const struct scene_material *m, VEC3 at, VEC3 normal, struct LANED(matter) *matter,
                       struct LANED(lit) *out)
{
	matter->at = at; /* Mesa never divides by w here (sundancer2). */
	matter->normal = normal;
	matter->to_viewer = m->local_viewer ? v3_normalize(v3_scale(at, SAME(-1.0f))) : SAME3(v3(0.0f, 0.0f, 1.0f));
	matter->is_long = v3_dot(normal, normal) > 1.01f;
	out->secondary = SAME4(v4(0.0f, 0.0f, 0.0f, 0.0f));
	out->lights = (WORD)(0u);
}

/* A highlight, before strength and colours are applied. */
LANES REAL light_shine(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *light, REAL shininess,
                       REAL n_h, REAL n_l)
{
	if (light_is_own_power(m, light))
		return M_POW(n_l, n_l);
	return CHOOSE(shininess == 0.0f, SAME(1.0f), M_POW(n_h, shininess));
}

/* Add light i of the list. share: NULL, or the share of its diffuse and specular light that arrives */
LANES void light_add(GLOBAL const struct scene_material *m, const struct LANED(matter) *matter,
                     GLOBAL const struct scene_light *light, uint32_t i, const VEC3 *share, struct LANED(lit) *out)
{
	VEC3 to_light;
	const REAL strength = light_strength(light, matter->at, &to_light), n_l = v3_dot(matter->normal, to_light);
	const MASK is_lit = n_l > 0.0f && strength > 0.0f;
	VEC4 matte, gloss;
	REAL shine = SAME(1.0f);

	out->color = v4_add(out->color, v4_scale(v4_mul(matter->ambient, SAME4(v4_load(light->ambient))), strength));
	if (!ANY(is_lit))
		return;
	matte = v4_scale(v4_mul(matter->diffuse, SAME4(v4_load(light->diffuse))), n_l * strength);
	gloss = v4_mul(matter->specular, SAME4(v4_load(light->specular)));
	/* A black highlight is skipped, whatever its power: the power is a number unless the normal is long. */
	if (ANY(is_lit && (gloss.x != 0.0f || gloss.y != 0.0f || gloss.z != 0.0f || matter->is_long))) {
		const VEC3 half_way = v3_normalize(v3_add(to_light, matter->to_viewer));
		const REAL n_h = M_MAX(v3_dot(matter->normal, half_way), SAME(0.0f));
		const MASK is_black = gloss.x == 0.0f && gloss.y == 0.0f && gloss.z == 0.0f && n_h <= 1.0f;

		shine = CHOOSE(is_black, SAME(1.0f), light_shine(m, light, matter->shininess, n_h, n_l));
	}
	gloss = v4_scale(gloss, shine * strength);
	if (light->radius >= 0.0f)
		out->lights |= CHOOSE(is_lit && matte.x + matte.y + matte.z + gloss.x + gloss.y + gloss.z > 0.0f,
		                      (WORD)(1u << i), (WORD)(0u));
	if (share) {
		matte = v4_mul(matte, V4(share->x, share->y, share->z, SAME(1.0f)));
		gloss = v4_mul(gloss, V4(share->x, share->y, share->z, SAME(1.0f)));
	}
	out->color = CHOOSE4(is_lit, v4_add(out->color, matte), out->color);
	if (m->separate_specular)
		out->secondary = CHOOSE4(is_lit, v4_add(out->secondary, gloss), out->secondary);
	else
		out->color = CHOOSE4(is_lit, v4_add(out->color, gloss), out->color);
}

/* Finish after the last light. */
LANES void light_end(GLOBAL const struct scene_material *m, const struct LANED(matter) *matter,
                     struct LANED(lit) *out)
{
	out->color.w = matter->diffuse.w;
	out->secondary.w = SAME(0.0f);
	if (!(m->unclamped & 2u)) {
		out->color = v4_clamp_vertex(out->color);
		out->secondary = v4_clamp_vertex(out->secondary);
	}
}
