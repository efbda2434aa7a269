#include "look/study/face.h"

#include <math.h>
#include <stddef.h>

#include "look/study/matrix.h"

int face_of(const struct scene_mesh *mesh, const double place[16], uint32_t primitive, struct face *out)
{
	double a[3], b[3];

	for (int c = 0; c < 3; c++) {
		const float *at = mesh->position + 4 * (size_t)mesh->index[3 * (size_t)primitive + (size_t)c];

		matrix_point(out->corner[c], place, (double[3]){ at[0], at[1], at[2] });
	}
	for (int k = 0; k < 3; k++) {
		a[k] = out->corner[1][k] - out->corner[0][k];
		b[k] = out->corner[2][k] - out->corner[0][k];
	}
	for (int k = 0; k < 3; k++)
		out->normal[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
	out->area = 0.5 * sqrt(matrix_dot3(out->normal, out->normal));
	return matrix_normalize3(out->normal);
}
