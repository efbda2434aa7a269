#include "look/between/place.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "look/draws/matrix.h"

static double distance(const double a[4], const double b[4])
{
	return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

void place_find(const struct scene_instance *in, const float box[2][3], const double *motion, struct place *out)
{
	double to[16], moved[16];

	matrix_from_floats(to, in->modelview);
	if (motion) {
		matrix_mul(moved, motion, to);
		memcpy(to, moved, sizeof(to));
	}
	for (int k = 0; k < 8; k++) {
		const double corner[4] = { (double)box[k & 1][0], (double)box[k >> 1 & 1][1], (double)box[k >> 2][2], 1 };

		matrix_transform(out->corner[k], to, corner);
	}
	out->size = DBL_MIN;
	for (int k = 0; k < 4; k++)
		out->size = fmax(out->size, distance(out->corner[k], out->corner[7 - k]));
}

double place_way(const struct place *a, const struct place *b)
{
	double most = 0;

	for (int k = 0; k < 8; k++)
		most = fmax(most, distance(a->corner[k], b->corner[k]));
	return most;
}
