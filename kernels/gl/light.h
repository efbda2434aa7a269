/*
 * GL's lighting of one vertex (GL 2.1 sec. 2.14.1 and 2.14.3). The same text lights a vertex for the rasterized picture
 * and again without the shadowed lights; if no light is shadowed, both results have the same bits.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"

/* A range of lights in the frame's list. */
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

/* Position of a light, or the direction to one at infinity. */
static inline struct vec3 light_place(GLOBAL const struct scene_light *light)
{
	const float w = light->position_eye[3];

	return w != 0.0f ? v3_scale(v3_load(light->position_eye), 1.0f / w) : v3_load(light->position_eye);
}

/*
 * 1 if Mesa (22.3.6, ffvertex_prog.c) raises the cosine to the light to the light's own power instead of a highlight's.
 * That happens if no highlight of the material has a power, and the light's strength varies with position.
 */
static inline int light_is_own_power(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *light)
{
	GLOBAL const float *a = light->attenuation;

	return m->front.shininess == 0.0f && (!m->two_side || m->back.shininess == 0.0f) && light->position_eye[3] != 0.0f &&
	       (light->spot_cutoff_deg != 180.0f || a[0] != 1.0f || a[1] != 0.0f || a[2] != 0.0f);
}

#include "kernels/gl/light_lanes.h"

/*
 * Light one side of a vertex.
 *
 * eye     the vertex in eye space, homogeneous
 * normal  normal of the lit side
 * face    the side's material
 * vertex_color  the current colour at the vertex, for color material
 * list    lights[list.first .. +list.count) light it, regardless of the material
 * matte_only  1: only the vertex colour of the material is used
 * seen    NULL, or each light's visibility: the share of its diffuse and specular light that arrives
 */
static inline struct lit light_vertex(GLOBAL const struct scene_material *m, GLOBAL const struct scene_light *lights,
                                      struct light_list list, int matte_only, struct vec4 eye, struct vec3 normal,
                                      GLOBAL const struct scene_face *face, struct vec4 vertex_color, int back,
                                      const struct vec3 *seen)
{
	struct matter matter;
	struct lit sum, out;

	if (matte_only)
		light_matte(vertex_color, &matter, &sum);
	else
		light_material(m, face, face, back, vertex_color, &matter, &sum);
	light_begin(m, v3(eye.x, eye.y, eye.z), normal, &matter, &sum);
	for (uint32_t i = 0u; i < list.count; i++)
		light_add(m, &matter, &lights[list.first + i], i, seen ? &seen[i] : (const struct vec3 *)0, &sum);
	light_end(m, &matter, &sum);
	out = sum; /* summed in a local variable, as compilers keep a returned struct in memory */
	return out;
}
