#include "look/study/motion/face.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "look/draws/matrix.h"

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

enum { CORNERS = 9 }; /* a triangle clipped by five planes has one less */

/* Clip a polygon by a side of the view volume; points where the sum is negative are outside. */
static unsigned cut(double (*p)[4], unsigned n, const double side[4])
{
	double out[CORNERS][4];
	unsigned m = 0;

	for (unsigned i = 0; i < n && m + 2 <= CORNERS; i++) {
		const double *a = p[i], *b = p[(i + 1) % n];
		double here = 0, there = 0;

		for (int k = 0; k < 4; k++) {
			here += a[k] * side[k];
			there += b[k] * side[k];
		}
		if (here >= 0)
			memcpy(out[m++], a, sizeof(out[0]));
		if ((here >= 0) == (there >= 0))
			continue;
		for (int k = 0; k < 4; k++)
			out[m][k] = a[k] + (b[k] - a[k]) * here / (here - there);
		m++;
	}
	memcpy(p, out, m * sizeof(out[0]));
	return m;
}

double face_share(const struct face *face, const float projection[16], double *size)
{
	static const double sides[5][4] = { { 0, 0, 1, 1 }, { 1, 0, 0, 1 }, { -1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, -1, 0, 1 } };
	double clip[16], p[CORNERS][4], row = 0, area = 0, w = 0;
	unsigned n = 3;

	matrix_from_floats(clip, projection);
	for (int c = 0; c < 3; c++)
		matrix_transform(p[c], clip, (double[4]){ face->corner[c][0], face->corner[c][1], face->corner[c][2], 1 });
	for (int k = 0; k < 5 && n; k++)
		n = cut(p, n, sides[k]);
	for (unsigned i = 0; i < n; i++) {
		const double *a = p[i], *b = p[(i + 1) % n];

		if (!(a[3] > 0) || !(b[3] > 0))
			return 0;
		area += (a[0] / a[3] * b[1] / b[3] - a[1] / a[3] * b[0] / b[3]) / 8;
		w += a[3] / n;
	}
	for (int k = 0; k < 3; k++)
		row += clip[4 * k] * clip[4 * k];
	*size = w / sqrt(row);
	return fabs(area);
}
