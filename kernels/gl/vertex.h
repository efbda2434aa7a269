/* GL's vertex stage (GL 2.1 chapter 2): takes one vertex of one instance to eye, clip and window space, lights it, and
 * generates and transforms its texture coordinates. */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"
#include "kernels/gl/clip.h"
#include "kernels/gl/light.h"
#include "kernels/gl/tables.h"

#include "kernels/gl/vertex_lanes.h"

/* Mesa's vertex programs treat subnormal numbers, those below FLT_MIN, as 0. */
static inline float vertex_flush(float a)
{
	return M_ABS(a) < FLT_MIN ? 0.0f : a;
}

static inline struct vec3 vertex_eye_normal(GLOBAL const struct geometry *g, GLOBAL const struct scene_material *m,
                                            struct vec3 n)
{
	struct vec3 eye = vertex_turn_normal(g->normal_matrix, n);
	struct vec3 flushed = v3(vertex_flush(eye.x), vertex_flush(eye.y), vertex_flush(eye.z));

	/* There, a normal too short to square has length 0, and becomes infinite. */
	if (m->normalize && vertex_flush(v3_dot(eye, eye)) == 0.0f &&
	    (flushed.x != 0.0f || flushed.y != 0.0f || flushed.z != 0.0f))
		return v3_scale(flushed, M_FLOAT(0x7f800000u));
	return m->normalize ? v3_normalize(eye) : eye;
}

/* A vertex's colour on one side; `seen` as in light_vertex. The fragment stage calls this again for shadows. */
static inline struct lit vertex_color(const struct tables *t, GLOBAL const struct geometry *g,
                                      GLOBAL const struct shaded_vertex *vertex, uint32_t v, int back,
                                      const struct vec3 *seen)
{
	GLOBAL const struct scene_material *m = &t->materials[g->material];
	struct vec3 normal = v3_load(vertex->normal);
	struct lit lit;

	if (m->vertex_program && seen) { /* unchanged: program.h runs the program again */
		lit.color = v4_load(vertex->color[back]);
		lit.secondary = v4_load(vertex->secondary[back]);
		lit.lights = vertex->lit[back];
		return lit;
	}
	if (m->lighting)
		return light_vertex(m, t->lights, light_list(m->light_first, m->light_count), 0, v4_load(vertex->eye),
		                    back ? v3_scale(normal, -1.0f) : normal, tables_face(t, g, v, back), tables_color(t, g, v),
		                    back, seen);
	lit.color = tables_color(t, g, v);
	lit.secondary = tables_secondary(t, g, v);
	if (!(m->unclamped & 2u)) {
		lit.color = vertex_clamp(lit.color, g->attributes & SCENE_HAS_COLOR);
		lit.secondary = vertex_clamp(lit.secondary, g->attributes & SCENE_HAS_SECONDARY);
	}
	lit.lights = 0u;
	return lit;
}

/* Store both sides' colours of a vertex whose position and normal are known. m: its material */
static inline void vertex_store_colors(const struct tables *t, GLOBAL const struct geometry *g,
                                       GLOBAL const struct scene_material *m, uint32_t v,
                                       GLOBAL struct shaded_vertex *out)
{
	const struct lit front = vertex_color(t, g, out, v, 0, (const struct vec3 *)0);
	const struct lit back = m->lighting && m->two_side ? vertex_color(t, g, out, v, 1, (const struct vec3 *)0) : front;

	v4_store(out->color[0], front.color);
	v4_store(out->color[1], back.color);
	v4_store(out->secondary[0], front.secondary);
	v4_store(out->secondary[1], back.secondary);
	out->lit[0] = m->surface.hidden & SCENE_UNSHADED ? 0u : front.lights;
	out->lit[1] = m->surface.hidden & SCENE_UNSHADED ? 0u : back.lights;
}

/* Texture coordinate generation, sec. 2.11.4; `u` the unit vector from the eye to the vertex, `n` the eye normal. */
static inline float vertex_generate(GLOBAL const struct scene_unit *unit, uint32_t c, float coord, struct vec4 obj,
                                    struct vec4 eye, struct vec3 u, struct vec3 n)
{
	struct vec3 r = v3_sub(u, v3_scale(n, 2.0f * v3_dot(n, u)));
	float m;

	switch (unit->gen_mode[c]) {
	case GL_OBJECT_LINEAR:
		return v4_dot(v4_load(unit->gen_object_plane[c]), obj);
	case GL_EYE_LINEAR:
		return v4_dot(v4_load(unit->gen_eye_plane[c]), eye);
	case GL_SPHERE_MAP:
		m = 2.0f * M_SQRT(r.x * r.x + r.y * r.y + (r.z + 1.0f) * (r.z + 1.0f));
		return (c == 0u ? r.x : r.y) / m + 0.5f;
	case GL_REFLECTION_MAP:
		return c == 0u ? r.x : c == 1u ? r.y : r.z;
	case GL_NORMAL_MAP:
		return c == 0u ? n.x : c == 1u ? n.y : n.z;
	default:
		return coord;
	}
}

/* Coordinates c after the unit's generation and transformation. */
static inline struct vec4 vertex_generated(GLOBAL const struct scene_unit *unit, struct vec4 c, struct vec4 obj,
                                           struct vec4 eye, struct vec3 n)
{
	struct vec3 u = v3_normalize(eye.w == 1.0f ? v3(eye.x, eye.y, eye.z) :
	                                             v3_scale(v3(eye.x, eye.y, eye.z), 1.0f / eye.w));

	c = v4(vertex_generate(unit, 0u, c.x, obj, eye, u, n), vertex_generate(unit, 1u, c.y, obj, eye, u, n),
	       vertex_generate(unit, 2u, c.z, obj, eye, u, n), vertex_generate(unit, 3u, c.w, obj, eye, u, n));
	return m4_mul(unit->matrix, c);
}

static inline struct vec4 vertex_texcoord(const struct tables *t, GLOBAL const struct geometry *g,
                                          GLOBAL const struct scene_unit *unit, uint32_t v, struct vec4 obj,
                                          struct vec4 eye, struct vec3 n)
{
	return vertex_generated(unit, tables_texcoord(t, g, v, unit->unit), obj, eye, n);
}

/* The vertex stage for vertex `item` of the frame. `owner[item]` is its instance. */
static inline void vertex_item(const struct vertex_arguments *a, uint32_t item)
{
	const struct tables *t = &a->tables;
	GLOBAL const struct geometry *g = &t->geometries[a->owners[item]];
	GLOBAL const struct scene_material *m = &t->materials[g->material];
	GLOBAL const struct view *view = &a->views[g->view];
	GLOBAL struct shaded_vertex *out = &a->shaded[item];
	uint32_t v = item - g->vertex_first;
	struct vec4 obj = v4_load(t->attributes + g->position + v * 4u);
	struct vec4 eye = m4_mul(g->eye_from_obj, obj), clip = m4_mul(g->clip_from_obj, obj);
	struct vec3 normal = vertex_eye_normal(g, m, tables_normal(t, g, v));

	v4_store(out->eye, eye);
	v4_store(out->clip, clip);
	v4_store(a->clips + item * 4u, clip);
	v3_store(out->normal, normal);
	a->windows[item] = clip_window(view, clip, (float)a->height);

	vertex_store_colors(t, g, m, v, out);
	out->fog_coord = m->fog_coord_source == GL_FOG_COORD ? tables_fog_coord(t, g, v) :
	                                                       vertex_fog_distance(m->fog_coord_source, eye);
	out->size[0] = vertex_point_size(m, eye);
	out->size[1] = 0.0f;

	for (uint32_t i = 0u; i < m->unit_count; i++)
		v4_store(a->coords + (g->texcoord_first + v * m->unit_count + i) * 4u,
		         vertex_texcoord(t, g, &t->units[m->unit_first + i], v, obj, eye, normal));
}

/*
 * window: the position of vertex `item` of the frame, as left by the vertex stage, in a viewport that has moved since.
 */
static inline void window_item(const struct window_arguments *a, uint32_t item)
{
	GLOBAL const struct view *view = &a->views[a->geometries[a->owners[item]].view];

	a->windows[item] = clip_window(view, v4_load(a->clips + item * 4u), (float)a->height);
}
