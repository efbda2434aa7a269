/*
 * Vertex programs (ARB_vertex_program); instructions.h runs them, for four vertices at once. The program's outputs
 * replace what fixed function (vertex.h) computed for a vertex: a clip position (the projection then recovers the eye
 * position); colours, texture coordinates, fog coordinate, point size. The normal remains fixed function's if the
 * position does.
 */
#pragma once

#include "kernels/gl/program_texture.h"
#include "kernels/gl/vertex.h"

#define VERTEX_DEPTH_INSIDE 0.9999f   /* as a share of w, since a ray's end may be rounded, */
#define VERTEX_DEPTH_OUTSIDE 1.00001f /* and so may a vertex on it */

/* A vertex's input, from enum scene_vertex_input. v: number in the mesh */
static inline struct vec4 vertex_input(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v,
                                       uint32_t input)
{
	struct vec3 normal;

	switch (input) {
	case SCENE_VERTEX_POSITION: return v4_load(t->attributes + g->position + v * 4u);
	case SCENE_VERTEX_NORMAL:
		normal = tables_normal(t, g, v);
		return v4(normal.x, normal.y, normal.z, 1.0f);
	case SCENE_VERTEX_COLOR: return tables_color(t, g, v);
	case SCENE_VERTEX_SECONDARY: return tables_secondary(t, g, v);
	case SCENE_VERTEX_FOG: return v4(tables_fog_coord(t, g, v), 0.0f, 0.0f, 1.0f);
	default:
		return input < SCENE_VERTEX_GENERIC ? tables_texcoord(t, g, v, input - SCENE_VERTEX_TEXCOORD) :
		                                      tables_generic(t, g, v, input - SCENE_VERTEX_GENERIC);
	}
}

/* A row of a projection; w: its last component */
static inline struct vec3 vertex_row(GLOBAL const float *m, uint32_t row)
{
	return v3(m[row], m[4u + row], m[8u + row]);
}

/*
 * Eye position for a clip position. Under a perspective projection, it is the place with the same x, y and w; depth is
 * not used, because a far place's depth has lost most of its bits. Otherwise it is found by the inverse, with the
 * resulting w.
 */
static inline struct vec4 vertex_eye_from_clip(GLOBAL const struct view *view, struct vec4 clip)
{
	GLOBAL const float *m = view->projection;
	const struct vec3 x = vertex_row(m, 0u), y = vertex_row(m, 1u), w = vertex_row(m, 3u), y_w = v3_cross(y, w);
	const float determinant = v3_dot(x, y_w);
	struct vec3 eye;

	if (determinant == 0.0f)
		return m4_mul(view->inverse, clip);
	eye = v3_add(v3_add(v3_scale(y_w, clip.x - m[12]), v3_scale(v3_cross(w, x), clip.y - m[13])),
	             v3_scale(v3_cross(x, y), clip.w - m[15]));
	return v4(eye.x / determinant, eye.y / determinant, eye.z / determinant, 1.0f);
}

/*
 * Eye position of a vertex that GL draws. It has to be between the ends of the rays that look for it. A program that
 * sets its own depth or w may have put it beyond them by x, y and w; then its own depth gives its place on the line of
 * sight.
 */
static inline struct vec4 vertex_drawn_eye(GLOBAL const struct view *view, struct vec4 clip)
{
	GLOBAL const float *m = view->projection;
	const struct vec4 eye = vertex_eye_from_clip(view, clip);
	const float depth = m[2] * eye.x + m[6] * eye.y + m[10] * eye.z + m[14] * eye.w, most = VERTEX_DEPTH_INSIDE * clip.w;
	struct vec4 at;

	if (!(clip.w > 0.0f && M_ABS(clip.z) <= clip.w && M_ABS(depth) > clip.w * VERTEX_DEPTH_OUTSIDE))
		return eye;
	at = m4_mul(view->inverse, v4(clip.x, clip.y, M_MIN(M_MAX(clip.z, -most), most), clip.w));
	return at.w > 0.0f ? v4_scale(at, 1.0f / at.w) : eye;
}

/* 1 if two clip positions are equal apart from rounding. */
static inline int vertex_is_same(struct vec4 a, struct vec4 b)
{
	const float most = 1.0e-5f * M_MAX(M_MAX(M_ABS(a.x), M_ABS(a.y)), M_MAX(M_ABS(a.z), M_ABS(a.w)));

	return M_ABS(a.x - b.x) <= most && M_ABS(a.y - b.y) <= most && M_ABS(a.z - b.z) <= most && M_ABS(a.w - b.w) <= most;
}

/* A result of number k of the four. */
static inline struct vec4 vertex_result(const struct program_run *run, uint32_t output, uint32_t k)
{
	return program_get(run, SCENE_VERTEX_RESULTS + 4u * output, k);
}

static inline struct vec4 vertex_result_color(const struct program_run *run, GLOBAL const struct scene_material *m,
                                              uint32_t output, uint32_t k)
{
	const struct vec4 color = vertex_result(run, output, k);

	return m->unclamped & 2u ? color : v4_clamp_vertex(color);
}

/* The listed lights that a program can light a vertex by: if it has a normal, those in front of it. */
static inline uint32_t vertex_lights(const struct tables *t, GLOBAL const struct scene_material *m,
                                     GLOBAL const struct shaded_vertex *vertex)
{
	const struct vec3 at = v3_load(vertex->eye), n = v3_load(vertex->normal);
	const int has_normal = m->program_normals && v3_dot(n, n) > 0.0f;
	uint32_t lights = 0u;

	for (uint32_t i = 0u; i < m->light_count; i++) {
		struct vec3 to_light;
		const float strength = light_strength(&t->lights[m->light_first + i], at, &to_light);

		if (!has_normal || (strength > 0.0f && (m->two_side || v3_dot(n, to_light) > 0.0f)))
			lights |= 1u << i;
	}
	return m->surface.hidden & SCENE_UNSHADED ? 0u : lights;
}

/* Store the program's results for vertex v, number k of the four. */
static inline void vertex_keep(const struct vertex_program_arguments *a, GLOBAL const struct geometry *g,
                               const struct program *program, const struct program_run *run, uint32_t v, uint32_t k)
{
	GLOBAL const struct scene_material *m = &a->tables.materials[g->material];
	GLOBAL const struct view *view = &a->views[g->view];
	GLOBAL struct shaded_vertex *out = &a->shaded[g->vertex_first + v];
	const uint32_t outputs = program->head->outputs;

	if (outputs >> SCENE_RESULT_POSITION & 1u) {
		const struct vec4 clip = vertex_result(run, SCENE_RESULT_POSITION, k);

		if (!vertex_is_same(v4_load(out->clip), clip)) { /* otherwise fixed function's eye position is more accurate */
			v4_store(out->eye, vertex_drawn_eye(view, clip));
			v3_store(out->normal, v3(0.0f, 0.0f, 0.0f)); /* unknown: use the triangle's */
		}
		v4_store(out->clip, clip);
		v4_store(a->clips + (g->vertex_first + v) * 4u, clip);
		a->windows[g->vertex_first + v] = clip_window(view, clip, (float)a->height);
	}
	out->lit[0] = out->lit[1] = vertex_lights(&a->tables, m, out);
	v4_store(out->color[0], vertex_result_color(run, m, SCENE_RESULT_COLOR, k));
	v4_store(out->color[1], m->clip_by_program ? vertex_result(run, SCENE_RESULT_CLIP_VERTEX, k) :
	                                             vertex_result_color(run, m, SCENE_RESULT_BACK_COLOR, k));
	v4_store(out->secondary[0], vertex_result_color(run, m, SCENE_RESULT_SECONDARY, k));
	v4_store(out->secondary[1], vertex_result_color(run, m, SCENE_RESULT_BACK_SECONDARY, k));
	out->fog_coord = vertex_result(run, SCENE_RESULT_FOG, k).x;
	if (outputs >> SCENE_RESULT_POINT_SIZE & 1u)
		out->size[0] = M_MIN(M_MAX(vertex_result(run, SCENE_RESULT_POINT_SIZE, k).x, m->point_size_min), m->point_size_max);
	for (uint32_t i = 0u; i < m->unit_count; i++)
		v4_store(a->coords + (g->texcoord_first + v * m->unit_count + i) * 4u,
		         vertex_result(run, SCENE_RESULT_TEXCOORD + a->tables.units[m->unit_first + i].unit, k));
}

/* Run the program for up to four vertices, number[n] in the mesh. seen: as in program_begin */
static inline void vertex_run(const struct tables *t, GLOBAL const struct geometry *g, const struct program *program,
                              const uint32_t *number, uint32_t n, const struct vec3 *seen, struct program_run *run)
{
	program_begin(run, program, (1u << n) - 1u, seen);
	for (uint32_t input = 0u; input < N_SCENE_VERTEX_INPUTS; input++)
		for (uint32_t k = 0u; k < n && program->head->inputs >> input & 1u; k++)
			program_set(run, 4u * input, k, vertex_input(t, g, number[k], input));
	program_execute(t, &t->materials[g->material], program, run);
}

/* vertex_program: runs after `vertex`; item: a vertex of the frame. Its instance's vertices are processed in fours,
 * each by the item of its first vertex. */
static inline void vertex_program_item(const struct vertex_program_arguments *a, uint32_t item)
{
	GLOBAL const struct geometry *g = &a->tables.geometries[a->owners[item]];
	GLOBAL const struct scene_material *m = &a->tables.materials[g->material];
	const uint32_t v = item - g->vertex_first, n = g->vertex_count - v < 4u ? g->vertex_count - v : 4u;
	uint32_t number[4];
	struct program program;
	struct program_run run;

	if (!m->vertex_program || v & 3u)
		return;
	program = program_at(a->programs + (m->vertex_program - 1u));
	for (uint32_t k = 0u; k < n; k++)
		number[k] = v + k;
	vertex_run(&a->tables, g, &program, number, n, (const struct vec3 *)0, &run);
	program_note_ended(a->programs + (m->vertex_program - 1u), run.ended);
	for (uint32_t k = 0u; k < n; k++)
		vertex_keep(a, g, &program, &run, v + k, k);
}
