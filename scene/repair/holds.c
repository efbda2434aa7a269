/* Tests by the winding number whether a mesh holds a place. */
#include "scene/repair/holds.h"

#include <math.h>

#include "base/vec3.h"

int holds_place(const struct scene_mesh *mesh, const float at[3])
{
	double around = 0; /* half the sum of the solid angles */

	for (size_t f = 0; f < mesh->primitive_count; f++) {
		double to[3][3], length[3], volume = 0;

		for (int c = 0; c < 3; c++) {
			const float *corner = mesh->position + 4 * (size_t)mesh->index[3 * f + (size_t)c];

			for (int k = 0; k < 3; k++)
				to[c][k] = (double)corner[k] - (double)at[k];
			length[c] = sqrt(vec3_dot(to[c], to[c]));
		}
		for (int k = 0; k < 3; k++)
			volume += to[0][k] * (to[1][(k + 1) % 3] * to[2][(k + 2) % 3] - to[1][(k + 2) % 3] * to[2][(k + 1) % 3]);
		volume = atan2(volume, length[0] * length[1] * length[2] + vec3_dot(to[0], to[1]) * length[2] +
		                               vec3_dot(to[1], to[2]) * length[0] + vec3_dot(to[2], to[0]) * length[1]);
		around += isfinite(volume) ? volume : 0;
	}
	return fabs(around) > M_PI;
}
