/* A frame's data as shading reads it: struct tables is a group of kernel arguments (kernels/kernels.h). */
#pragma once

#include "kernels/common.h"
#include "kernels/kernels.h"

/* A vertex attribute: the mesh's own, or the current value if the mesh has none. `v` is a number in the mesh. */
static inline struct vec4 tables_color(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & SCENE_HAS_COLOR ? v4_load(t->attributes + g->color + v * 4u) :
	                                         v4_load(t->currents[g->current].color);
}

static inline struct vec4 tables_secondary(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & SCENE_HAS_SECONDARY ? v4_load(t->attributes + g->secondary + v * 4u) :
	                            v4_load(t->currents[g->current].secondary);
}

static inline struct vec3 tables_normal(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & SCENE_HAS_NORMAL ? v3_load(t->attributes + g->normal + v * 3u) :
	                            v3_load(t->currents[g->current].normal);
}

/* A side's material at a vertex: the mesh's own if it changes from vertex to vertex (allowed by sec. 2.6.3), else the
 * draw's. */
static inline GLOBAL const struct scene_face *tables_face(const struct tables *t, GLOBAL const struct geometry *g,
                                                          uint32_t v, int back)
{
	GLOBAL const struct scene_material *m = &t->materials[g->material];

	if (g->attributes & SCENE_HAS_FACE)
		return (GLOBAL const struct scene_face *)(t->attributes + g->face) + 2u * v + (back ? 1u : 0u);
	return back ? &m->back : &m->front;
}

/* Generic attribute 1 + i of vertex programs. */
static inline struct vec4 tables_generic(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v,
                                         uint32_t i)
{
	uint32_t before = 0u;

	for (uint32_t k = 0u; k < i; k++)
		before += g->attributes / SCENE_HAS_GENERIC >> k & 1u;
	return g->attributes & (SCENE_HAS_GENERIC << i) ?
	               v4_load(t->attributes + g->generics + (before * g->vertex_count + v) * 4u) :
	               v4_load(t->currents[g->current].generics[i]);
}

static inline float tables_fog_coord(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & SCENE_HAS_FOG_COORD ? t->attributes[g->fog_coord + v] : t->currents[g->current].fog_coord;
}

static inline struct vec4 tables_texcoord(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v,
                                          uint32_t unit)
{
	return g->attributes & (SCENE_HAS_TEXCOORD << unit) ? v4_load(t->attributes + g->texcoord[unit] + v * 4u) :
	                                       v4_load(t->currents[g->current].texcoord[unit]);
}
