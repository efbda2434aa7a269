#include "look/study/motion/box.h"

#include <math.h>
#include <stddef.h>

#include "look/draws/matrix.h"

const struct box box_empty = { { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL } };

void box_widen(struct box *b, const double at[3])
{
	for (int k = 0; k < 3; k++) {
		b->low[k] = fmin(b->low[k], at[k]);
		b->high[k] = fmax(b->high[k], at[k]);
	}
}

struct box box_of(const struct scene_mesh *mesh, const double place[16])
{
	struct box box = box_empty;

	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		const float *p = mesh->position + 4 * (size_t)v;
		double at[3];

		matrix_point(at, place, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		box_widen(&box, at);
	}
	return box;
}

double box_measure(const struct box *b, double middle[3])
{
	const int is_empty = b->low[0] > b->high[0];
	double square = 0;

	for (int k = 0; k < 3; k++) {
		middle[k] = is_empty ? 0 : 0.5 * (b->low[k] + b->high[k]);
		square += is_empty ? 0 : (b->high[k] - b->low[k]) * (b->high[k] - b->low[k]);
	}
	return sqrt(square);
}
