#include "look/between/bridge.h"

#include <math.h>

#include "look/matrix.h"

#define MOST_TRIANGLES 64u /* sampled of a draw */

/* The area of a triangle on the picture; 0: it is not there, its middle not in view, or a corner behind the viewer. */
static double shown_area(const struct scene *s, const struct scene_instance *in, uint32_t triangle)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	double eye[16], projection[16], at[3][2], middle[2] = { 0, 0 };

	matrix_from_floats(eye, in->modelview);
	matrix_from_floats(projection, s->views[in->view].projection);
	if (triangle >= mesh->primitive_count)
		return 0;
	for (int k = 0; k < 3; k++) {
		const float *v = mesh->position + 4 * (size_t)mesh->index[3 * (size_t)triangle + (size_t)k];
		const double object[4] = { (double)v[0], (double)v[1], (double)v[2], (double)v[3] };
		double seen[4], clip[4];

		matrix_transform(seen, eye, object);
		matrix_transform(clip, projection, seen);
		if (!(clip[3] > 0))
			return 0;
		for (int i = 0; i < 2; i++) {
			at[k][i] = clip[i] / clip[3];
			middle[i] += at[k][i] / 3;
		}
	}
	if (!(fabs(middle[0]) <= 1 && fabs(middle[1]) <= 1))
		return 0;
	return fabs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]));
}

int bridge_is_cut(const struct bridge *b)
{
	const struct scene *s = b->mixer.base, *other = b->mixer.other;
	double all = 0, kept = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_mesh *mesh = s->meshes[in->mesh];
		const uint32_t step = mesh->primitive_count / MOST_TRIANGLES + 1;

		if (mesh->kind != SCENE_TRIANGLES || in->rectangle || !s->materials[in->material].depth_test ||
		    s->materials[in->material].vertex_program || s->views[in->view].target)
			continue;
		for (uint32_t t = 0; t < mesh->primitive_count; t += step) {
			const double area = fmin(4, shown_area(s, in, t)) * step;

			all += area;
			if (area > 0 && b->couples[i].other != SCENE_NONE &&
			    shown_area(other, &other->instances[b->couples[i].other], t) > 0)
				kept += area;
		}
	}
	return kept < all / 2;
}
