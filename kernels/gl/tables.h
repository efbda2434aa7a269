/* Where the shading text finds a frame's data: the kernel's buffers under names. Lives in a work item's own memory. */
#ifndef KERNELS_GL_TABLES_H
#define KERNELS_GL_TABLES_H

#include "kernels/common.h"

struct tables {
	GLOBAL const struct geometry *geometries;       /* per instance */
	GLOBAL const struct scene_material *materials;
	GLOBAL const struct scene_light *lights;
	GLOBAL const struct scene_unit *units;
	GLOBAL const struct scene_current *currents;
	GLOBAL const float *attributes;                 /* vertex arrays of all meshes */
	GLOBAL const uint32_t *indices;                 /* and their indices */
	GLOBAL const struct shaded_vertex *vertices;    /* what the vertex stage made of them */
	GLOBAL const float *texcoords;                  /* [4] for each vertex and enabled unit */
	GLOBAL const struct texture_image *textures;
	GLOBAL const uint32_t *texels;
	GLOBAL const uint32_t *stipples;                /* 32 rows each */
};

/* The first arguments of every shading kernel, and how they get their names. */
#define N_TABLES 12
#ifdef __OPENCL_VERSION__
#define TABLES_ARGUMENTS \
	__global const struct geometry *geometries, __global const struct scene_material *materials, \
	__global const struct scene_light *lights, __global const struct scene_unit *units, \
	__global const struct scene_current *currents, __global const float *attributes, \
	__global const uint32_t *indices, __global const struct shaded_vertex *vertices, \
	__global const float *texcoords, __global const struct texture_image *textures, \
	__global const uint32_t *texels, __global const uint32_t *stipples
#define TABLES_NAMED { geometries, materials, lights, units, currents, attributes, indices, vertices, texcoords, \
	textures, texels, stipples }
#else
#define TABLES_NAMED { args[0], args[1], args[2], args[3], args[4], args[5], args[6], args[7], args[8], args[9], \
	args[10], args[11] }
#endif

/* A vertex attribute: the mesh's own, or the current one where the mesh has none. `v` counts in the mesh. */
static inline struct vec4 tables_color(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & 2u ? v4_load(t->attributes + g->color + v * 4u) : v4_load(t->currents[g->current].color);
}

static inline struct vec4 tables_secondary(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & 4u ? v4_load(t->attributes + g->secondary + v * 4u) :
	                            v4_load(t->currents[g->current].secondary);
}

static inline struct vec3 tables_normal(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & 1u ? v3_load(t->attributes + g->normal + v * 3u) :
	                            v3_load(t->currents[g->current].normal);
}

/* A side's material at a vertex: the mesh's own where it changes from vertex to vertex (sec. 2.6.3 lets it), or the draw's. */
static inline GLOBAL const struct scene_face *tables_face(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v, int back)
{
	GLOBAL const struct scene_material *m = &t->materials[g->material];

	if (g->attributes & 0x1000u)
		return (GLOBAL const struct scene_face *)(t->attributes + g->face) + 2u * v + (back ? 1u : 0u);
	return back ? &m->back : &m->front;
}

static inline float tables_fog_coord(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v)
{
	return g->attributes & 8u ? t->attributes[g->fog_coord + v] : t->currents[g->current].fog_coord;
}

static inline struct vec4 tables_texcoord(const struct tables *t, GLOBAL const struct geometry *g, uint32_t v,
                                          uint32_t unit)
{
	return g->attributes & (16u << unit) ? v4_load(t->attributes + g->texcoord[unit] + v * 4u) :
	                                       v4_load(t->currents[g->current].texcoord[unit]);
}

#endif
