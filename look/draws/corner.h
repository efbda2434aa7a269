/* Corners of a mesh's triangles, in object space. */
#pragma once

#include "scene/scene.h"

/* Position of a corner (0 to 2): x, y, z, w. */
static inline const float *corner_place(const struct scene_mesh *mesh, uint32_t primitive, unsigned corner)
{
	return mesh->position + 4 * (size_t)mesh->index[3 * (size_t)primitive + corner];
}

/* The normal that lights a corner: the mesh's own, or the current normal. */
static inline const float *corner_normal(const struct scene *scene, const struct scene_instance *in, uint32_t primitive,
                                         unsigned corner)
{
	const struct scene_mesh *mesh = scene->meshes[in->mesh];

	return mesh->normal ? mesh->normal + 3 * (size_t)mesh->index[3 * (size_t)primitive + corner] :
	                      scene->currents[in->current].normal;
}
