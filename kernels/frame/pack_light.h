/*
 * Sixteen points of one material lit where they are, instead of between lit vertices: what point_lit_here and
 * light_vertex have for one, in the same order of operations and to the same bits. OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack_combine.h"
#include "kernels/frame/pack_surface.h"

/* What the lights of a list do to points. */
struct pack_lit_here {
	struct pack_color color, secondary;
	packu lights; /* as struct lit has them */
};

/* The colours of points under white light, and where they look. */
struct pack_matter {
	packf ambient[4], diffuse[4], specular[4], shininess;
	struct vec3_16 at, normal, to_viewer;
	packi has_gloss;
	__global const struct scene_material *material;
};

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/* The current colours (glColor) of the vertices of some lanes; of the others undefined. */
static inline void pack_vertex_colors(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                      uint lanes, packf (*v)[4])
{
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		const uint from = lanes >> lane & 1 ? lane : popcount((lanes & -lanes) - 1);
		__global const struct geometry *g = &t->geometries[list->instance[from]];

		for (uint k = 0; k < 3; k++) {
			const struct vec4 c = tables_color(t, g, LANE(p->number[k], uint, lane));

			LANE(v[k][0], float, lane) = c.x;
			LANE(v[k][1], float, lane) = c.y;
			LANE(v[k][2], float, lane) = c.z;
			LANE(v[k][3], float, lane) = c.w;
		}
	}
}

/* As point_current_color. */
static inline struct pack_color pack_current_color(const struct tables *t, const struct pack_list *list,
                                                   const struct pack *p, uint lanes)
{
	struct pack_color out;
	packf v[3][4];

	pack_vertex_colors(t, list, p, lanes, v);
	for (int i = 0; i < 4; i++)
		out.c[i] = p->material->shade_model == GL_FLAT ? v[2][i] : pack_mix(p, v[0][i], v[1][i], v[2][i]);
	return out;
}

/* As point_matte_color. */
static inline struct pack_color pack_matte_color(const struct tables *t, const struct pack_list *list,
                                                 const struct pack *p, uint lanes)
{
	struct pack_color out = pack_current_color(t, list, p, lanes);

	if (p->material->surface.light_unit == SCENE_LIGHT_IN_COLORS)
		out.c[0] = out.c[1] = out.c[2] = (packf)(1);
	return out;
}

/* --- Lights ------------------------------------------------------------------------------------------------------ */

/* As light_spot. */
static inline packf pack_spot(__global const struct scene_light *light, struct vec3_16 to_light)
{
	const struct vec3 axis = v3_normalize(v3_load(light->spot_direction_eye));
	packf along;
	packi inside;

	if (light->spot_cutoff_deg == 180.0f)
		return 1.0f;
	along = -v3_dot(to_light, v3_16(axis.x, axis.y, axis.z));
	inside = ~(along <= fmax(cos(light->spot_cutoff_deg * 0.017453292519943295f), 0.0f));
	if (light->spot_exponent != 0.0f)
		along = pow(along, (packf)(light->spot_exponent));
	else
		along = 1.0f;
	return select((packf)(0), along, inside);
}

/* As light_strength. */
static inline packf pack_strength(__global const struct scene_light *light, struct vec3_16 at, struct vec3_16 *to_light)
{
	const float w = light->position_eye[3];
	const struct vec3 place = w != 0.0f ? v3_scale(v3_load(light->position_eye), 1.0f / w) : v3_load(light->position_eye);
	struct vec3_16 to = v3_16(place.x, place.y, place.z);
	packf strength = 1.0f, distance;

	if (w != 0.0f) {
		to = v3_sub(to, at);
		distance = sqrt(v3_dot(to, to));
		strength = light->attenuation[1] == 0.0f && light->attenuation[2] == 0.0f ?
		                   (packf)(1.0f / light->attenuation[0]) :
		                   1.0f / (light->attenuation[0] +
		                           distance * (light->attenuation[1] + distance * light->attenuation[2]));
	}
	*to_light = v3_normalize(to);
	return strength * pack_spot(light, *to_light);
}

/* The shares of a slot's light that reach some lanes, as stage_seen has them. */
static inline void pack_seen(const struct shade_arguments *a, const struct pack_list *list, uint lanes, uint slot,
                             packf *share)
{
	share[0] = share[1] = share[2] = 1.0f;
	if (slot >= a->n_slots)
		return;
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		__global const float *seen = a->visibility + (slot * a->n + list->item[lane]) * 3u;

		for (int i = 0; i < 3; i++)
			LANE(share[i], float, lane) = seen[i];
	}
}

/* What one light adds. share: how much of it reaches the points */
static inline void pack_add_light(const struct pack_matter *m, __global const struct scene_light *light, uint lanes,
                                  const packf *share, packu bit, int apart, struct pack_lit_here *out)
{
	struct vec3_16 to_light;
	const packf strength = pack_strength(light, m->at, &to_light), n_l = v3_dot(m->normal, to_light);
	const packi is_lit = (n_l > 0.0f) & (strength > 0.0f);
	const packf matte_share = n_l * strength;
	packf shine = 1.0f, sum = 0.0f;

	lanes &= pack_bits(is_lit);
	if (lanes && any_pack(m->has_gloss)) {
		const packf n_h = fmax(v3_dot(m->normal, v3_normalize(v3_add(to_light, m->to_viewer))), (packf)(0));

		shine = light_is_own_power(m->material, light) ? pow(n_l, n_l) :
		                                                 select((packf)(1), pow(n_h, m->shininess), m->shininess != 0.0f);
	}
	shine *= strength;
	for (int i = 0; i < 4; i++)
		out->color.c[i] += m->ambient[i] * light->ambient[i] * strength;
	for (int i = 0; i < 3; i++)
		sum += m->diffuse[i] * light->diffuse[i] * matte_share;
	for (int i = 0; i < 3; i++)
		sum += m->specular[i] * light->specular[i] * shine;
	if (light->radius >= 0.0f)
		out->lights |= select((packu)(0), bit, is_lit & (sum > 0.0f));
	for (int i = 0; i < 3; i++) {
		packf *gloss_to = apart ? &out->secondary.c[i] : &out->color.c[i];
		const packf matte = m->diffuse[i] * light->diffuse[i] * matte_share * share[i];
		const packf gloss = m->specular[i] * light->specular[i] * shine * share[i];

		out->color.c[i] = select(out->color.c[i], out->color.c[i] + matte, is_lit);
		*gloss_to = select(*gloss_to, *gloss_to + gloss, is_lit);
	}
}

/* --- Points ------------------------------------------------------------------------------------------------------ */

/* A colour of the material's sides, or the vertices' where the side tracks them. */
static inline void pack_own_color(__global const float *front, __global const float *back, packi side, packi tracked,
                                  const struct pack_color *vertex, packf *out)
{
	for (int i = 0; i < 4; i++)
		out[i] = select(select((packf)(front[i]), (packf)(back[i]), side), vertex->c[i], tracked);
}

/*
 * The material of a side under white light. side: all ones for the back; current: the points' current colours
 * matter: receives all but place, normal and viewer; out: the light that no light sends
 */
static inline void pack_material(__global const struct scene_material *m, packi side, const struct pack_color *current,
                                 struct pack_matter *matter, struct pack_color *out)
{
	const packi back = m->color_material == GL_BACK ? (packi)(-1) : (packi)(0);
	const packi front = m->color_material == GL_FRONT ? (packi)(-1) : (packi)(0);
	const packi tracks = m->color_material == GL_FRONT_AND_BACK ? (packi)(-1) : select(front, back, side), none = 0;
	const uint mode = m->color_material ? m->color_material_mode : 0;
	packf emission[4];

	pack_own_color(m->front.ambient, m->back.ambient, side,
	               mode == GL_AMBIENT || mode == GL_AMBIENT_AND_DIFFUSE ? tracks : none, current, matter->ambient);
	pack_own_color(m->front.diffuse, m->back.diffuse, side,
	               mode == GL_DIFFUSE || mode == GL_AMBIENT_AND_DIFFUSE ? tracks : none, current, matter->diffuse);
	pack_own_color(m->front.specular, m->back.specular, side, mode == GL_SPECULAR ? tracks : none, current,
	               matter->specular);
	pack_own_color(m->front.emission, m->back.emission, side, mode == GL_EMISSION ? tracks : none, current, emission);
	for (int i = 0; i < 4; i++)
		out->c[i] = emission[i] + matter->ambient[i] * m->light_model_ambient[i];
	matter->shininess = select((packf)(m->front.shininess), (packf)(m->back.shininess), side);
	matter->has_gloss = (matter->specular[0] != 0.0f) | (matter->specular[1] != 0.0f) | (matter->specular[2] != 0.0f);
}

/* Of what OpenGL lights. out: receives the light that no light sends, too */
static inline void pack_lit_matter(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                   uint lanes, struct pack_matter *matter, struct pack_color *out)
{
	const packi side = pack_side(p);
	struct pack_color current;
	struct vec3_16 n;

	for (int i = 0; i < 4; i++)
		current.c[i] = 0.0f;
	if (p->material->color_material && p->material->color_material_mode)
		current = pack_current_color(t, list, p, lanes);
	pack_material(p->material, side, &current, matter, out);
	n = pack_vertex_normals(t, p);
	matter->normal = v3_choose(side, v3_scale(n, (packf)(-1)), n);
}

/* Of what only rules light. */
static inline void pack_unlit_matter(const struct tables *t, const struct pack_list *list, const struct pack *p,
                                     const struct pack_surface *s, uint lanes, struct pack_matter *matter,
                                     struct pack_color *out)
{
	const struct pack_color matte = pack_matte_color(t, list, p, lanes);

	for (int i = 0; i < 4; i++) {
		matter->ambient[i] = matter->diffuse[i] = matte.c[i];
		matter->specular[i] = out->c[i] = 0.0f;
	}
	matter->shininess = 0.0f;
	matter->has_gloss = 0;
	matter->normal = pack_normal(t, p, s);
}

/* Before the first light. m: of its points */
static inline void pack_light_begin(__global const struct scene_material *m, struct pack_matter *matter,
                                    struct pack_lit_here *out)
{
	matter->material = m;
	matter->to_viewer = v3_16((packf)(0), (packf)(0), (packf)(1));
	if (m->local_viewer)
		matter->to_viewer = v3_normalize(v3_scale(matter->at, (packf)(-1)));
	for (int i = 0; i < 4; i++)
		out->secondary.c[i] = 0.0f;
	out->lights = 0;
}

/* After the last one. */
static inline void pack_light_end(const struct pack_matter *matter, struct pack_lit_here *out)
{
	out->color.c[3] = matter->diffuse[3];
	for (int i = 0; i < 4; i++) {
		out->color.c[i] = clamp_vertex(out->color.c[i]);
		out->secondary.c[i] = clamp_vertex(out->secondary.c[i]);
	}
}

/*
 * As point_lit_here, for surfaces that rules light anew (scene_surface.relit).
 * a: tables, and the visibility of the lights where there are n_slots
 */
static inline void pack_lit_here(const struct shade_arguments *a, const struct pack_list *list, const struct pack *p,
                                 const struct pack_surface *s, uint lanes, struct pack_lit_here *out)
{
	const struct tables *t = &a->tables;
	__global const struct scene_material *m = p->material;
	struct pack_matter matter;

	if (m->lighting)
		pack_lit_matter(t, list, p, lanes, &matter, &out->color);
	else
		pack_unlit_matter(t, list, p, s, lanes, &matter, &out->color);
	matter.at = pack_place_at(s, p->weight);
	pack_light_begin(m, &matter, out);
	for (uint i = 0; i < m->surface.light_count; i++) {
		packf share[3];

		pack_seen(a, list, lanes, i, share);
		pack_add_light(&matter, &t->lights[m->surface.light_first + i], lanes, share, (packu)(1u << i),
		               m->separate_specular, out);
	}
	pack_light_end(&matter, out);
}
