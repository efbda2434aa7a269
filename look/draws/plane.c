#include "look/draws/plane.h"

#include <math.h>
#include <stddef.h>

#include "base/mat4.h"

#define MOST_POINTS 0.9f /* share of the points that must lie in the plane */
#define OFF 1e-3f /* tolerance, as a share of a point's distance */

int plane_holds(const struct scene *scene, const struct scene_instance *instance, const float plane[4])
{
	const struct scene_mesh *mesh = scene->meshes[instance->mesh];
	uint32_t n = 0;

	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		float at[4];

		mat4_transform(at, instance->modelview, mesh->position + 4 * (size_t)v);
		n += fabsf(plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3] * at[3]) <=
		     OFF * (fabsf(at[3]) + fabsf(at[0]) + fabsf(at[1]) + fabsf(at[2]));
	}
	return n > 0 && (float)n >= MOST_POINTS * (float)mesh->vertex_count;
}
