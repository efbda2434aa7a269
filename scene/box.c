/* Bounding boxes of meshes. */
#include "scene/box.h"

#include <math.h>

void scene_box_grow(const struct scene_mesh *mesh, float low[3], float high[3])
{
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++) {
			low[k] = fminf(low[k], mesh->position[4 * (size_t)v + (size_t)k]);
			high[k] = fmaxf(high[k], mesh->position[4 * (size_t)v + (size_t)k]);
		}
}

void scene_box(const struct scene_mesh *mesh, float low[3], float high[3])
{
	for (int k = 0; k < 3; k++) {
		low[k] = INFINITY;
		high[k] = -INFINITY;
	}
	scene_box_grow(mesh, low, high);
	for (int k = 0; k < 3; k++)
		if (!(low[k] <= high[k]))
			low[k] = high[k] = 0;
}
