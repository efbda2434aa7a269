/*
 * GL's lighting of one vertex (GL 2.1 sec. 2.14.1 and 2.14.3). The same text lights a vertex for the rasterized picture
 * and again with the shadowed lights left out: with none left out the results are the same bits.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"

struct lit {
	struct vec4 color, secondary; /* clamped; secondary is 0 unless the specular colour is kept apart */
	uint32_t lights;              /* bit i: light i of the list adds diffuse or specular light that something may stop */
};

/* Lights that stand side by side in the frame's. */
struct light_list {
	uint32_t first, count;
};

static inline struct light_list light_list(uint32_t first, uint32_t count)
{
	struct light_list list;

	list.first = first;
	list.count = count;
	return list;
}

/* The material's own colours of a side, or the vertex's where color material tracks them (sec. 2.14.3). */
static inline struct vec4 light_material_color(GLOBAL const float *own, uint32_t tracked, struct vec4 vertex_color)
{
	return tracked ? vertex_color : v4_load(own);
}

/* Spot factor for the unit vector towards the light (equation in sec. 2.14.1). On the very edge of its cone Mesa
 * (22.3.6) has no light. */
static inline float light_spot(GLOBAL const struct scene_light *light, struct vec3 to_light)
{
	struct vec3 axis = v3_normalize(v3_load(light->spot_direction_eye));
	float along = -v3_dot(to_light, axis);

	if (light->spot_cutoff_deg == 180.0f)
		return 1.0f;
	if (along <= M_MAX(M_COS(light->spot_cutoff_deg * 0.017453292519943295f), 0.0f))
		return 0.0f;
	return light->spot_exponent == 0.0f ? 1.0f : M_POW(along, light->spot_exponent);
}

/*
 * 1 where Mesa (22.3.6, ffvertex_prog.c) raises the cosine to the light to its own power in place of a highlight's:
 * no material's highlight has a power, and the light's strength differs from place to place.
 */
static inline int light_is_own_power(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *light)
{
	GLOBAL const float *a = light->attenuation;

	return m->front.shininess == 0.0f && (!m->two_side || m->back.shininess == 0.0f) && light->position_eye[3] != 0.0f &&
	       (light->spot_cutoff_deg != 180.0f || a[0] != 1.0f || a[1] != 0.0f || a[2] != 0.0f);
}

/* A highlight, before strength and colours. */
static inline float light_shine(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *light,
                                float shininess, float n_h, float n_l)
{
	if (light_is_own_power(m, light))
		return M_POW(n_l, n_l);
	return shininess == 0.0f ? 1.0f : M_POW(n_h, shininess);
}

/* Attenuation of a light at a place, spot factor included, and the unit vector towards it. */
static inline float light_strength(GLOBAL const struct scene_light *light, struct vec3 at, struct vec3 *to_light)
{
	struct vec3 to = v3_load(light->position_eye);
	float strength = 1.0f;

	if (light->position_eye[3] != 0.0f) {
		float distance;

		to = v3_sub(v3_scale(to, 1.0f / light->position_eye[3]), at);
		distance = M_SQRT(v3_dot(to, to));
		/* A light may be farther away than numbers go, when the distance must not be looked at. */
		strength = light->attenuation[1] == 0.0f && light->attenuation[2] == 0.0f ?
		                   1.0f / light->attenuation[0] :
		                   1.0f / (light->attenuation[0] +
		                           distance * (light->attenuation[1] + distance * light->attenuation[2]));
	}
	*to_light = v3_normalize(to);
	return strength * light_spot(light, *to_light);
}

/*
 * Light one side of a vertex.
 *
 * eye     the vertex in eye space, homogeneous
 * normal  of the side to be lit
 * face    the side's material
 * vertex_color  the current colour at the vertex, for color material
 * list    lights[list.first .. +list.count) light it, whatever the material says
 * matte_only  1: of the material only the vertex colour counts
 * seen    NULL, or each light's visibility: the share of its diffuse and specular light that counts
 */
static inline struct lit light_vertex(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *lights,
                                      struct light_list list, int matte_only, struct vec4 eye, struct vec3 normal,
                                      GLOBAL const struct scene_face *face, struct vec4 vertex_color, int back,
                                      const struct vec3 *seen)
{
	uint32_t tracks = m->color_material == GL_FRONT_AND_BACK || m->color_material == (back ? GL_BACK : GL_FRONT);
	uint32_t mode = tracks ? m->color_material_mode : 0u;
	struct vec4 ambient = light_material_color(face->ambient, mode == GL_AMBIENT || mode == GL_AMBIENT_AND_DIFFUSE,
	                                           vertex_color);
	struct vec4 diffuse = light_material_color(face->diffuse, mode == GL_DIFFUSE || mode == GL_AMBIENT_AND_DIFFUSE,
	                                           vertex_color);
	struct vec4 specular = light_material_color(face->specular, mode == GL_SPECULAR, vertex_color);
	struct vec4 emission = light_material_color(face->emission, mode == GL_EMISSION, vertex_color);
	struct vec4 primary = v4_add(emission, v4_mul(ambient, v4_load(m->light_model_ambient)));
	struct vec4 secondary = v4(0.0f, 0.0f, 0.0f, 0.0f);
	struct vec3 at = v3(eye.x, eye.y, eye.z); /* Mesa never divides by w here (sundancer2) */
	struct vec3 to_viewer = m->local_viewer ? v3_normalize(v3_scale(at, -1.0f)) : v3(0.0f, 0.0f, 1.0f);
	struct lit out;

	if (matte_only) {
		ambient = diffuse = vertex_color;
		specular = primary = v4(0.0f, 0.0f, 0.0f, 0.0f);
	}
	out.lights = 0u;
	for (uint32_t i = 0u; i < list.count; i++) {
		GLOBAL const struct scene_light *light = &lights[list.first + i];
		struct vec3 to_light;
		struct vec4 ambient_light = v4_mul(ambient, v4_load(light->ambient));
		float strength = light_strength(light, at, &to_light), n_l;

		primary = v4_add(primary, v4_scale(ambient_light, strength));
		n_l = v3_dot(normal, to_light);
		if (n_l > 0.0f && strength > 0.0f) {
			struct vec3 half_way = v3_normalize(v3_add(to_light, to_viewer));
			float n_h = M_MAX(v3_dot(normal, half_way), 0.0f);
			struct vec4 matte = v4_scale(v4_mul(diffuse, v4_load(light->diffuse)), n_l * strength);
			struct vec4 gloss = v4_mul(specular, v4_load(light->specular));
			int is_black = gloss.x == 0.0f && gloss.y == 0.0f && gloss.z == 0.0f &&
			               n_h <= 1.0f; /* whatever the power, which is a number */
			float shine = is_black ? 1.0f : light_shine(m, light, face->shininess, n_h, n_l);

			gloss = v4_scale(gloss, shine * strength);

			if (light->radius >= 0.0f && matte.x + matte.y + matte.z + gloss.x + gloss.y + gloss.z > 0.0f)
				out.lights |= 1u << i;
			if (seen) {
				struct vec4 share = v4(seen[i].x, seen[i].y, seen[i].z, 1.0f);

				matte = v4_mul(matte, share);
				gloss = v4_mul(gloss, share);
			}
			primary = v4_add(primary, matte);
			if (m->separate_specular)
				secondary = v4_add(secondary, gloss);
			else
				primary = v4_add(primary, gloss);
		}
	}
	primary.w = diffuse.w;
	secondary.w = 0.0f;
	out.color = m->unclamped & 2u ? primary : v4_clamp_vertex(primary);
	out.secondary = m->unclamped & 2u ? secondary : v4_clamp_vertex(secondary);
	return out;
}
