/* Places and motions of matched draws. */
#include "look/between/bridge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "look/between/mixed.h"
#include "look/between/pose.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"

const float *bridge_place(const struct bridge *b, uint32_t i, int second)
{
	return second == b->is_back ? b->base->instances[i].modelview :
	                              b->other->instances[b->couples[i].other].modelview;
}

void bridge_corner(const struct bridge *b, uint32_t i, int k, double out[4])
{
	const float (*box)[3] = (const float (*)[3])b->boxes[b->base->instances[i].mesh];

	for (int c = 0; c < 3; c++)
		out[c] = (double)box[k >> c & 1][c];
	out[3] = 1;
}

void bridge_find_motion(struct bridge *b, uint32_t i)
{
	struct couple *c = &b->couples[i];
	double first[16], second[16], back[16], part[16], corner[4], far = 0;

	matrix_from_floats(first, bridge_place(b, i, 0));
	matrix_from_floats(second, bridge_place(b, i, 1));
	for (int k = 0; k < 8; k++) {
		bridge_corner(b, i, k, corner);
		matrix_transform(c->corner[k], first, corner);
	}
	for (int k = 0; k < 3; k++)
		far = hypot(far, c->corner[7][k] - c->corner[0][k]);
	c->size = far;
	c->moves = 0;
	if (!matrix_invert(back, first))
		return;
	matrix_mul(c->motion, second, back);
	c->moves = pose_part(part, c->motion, 0.5);
}

int bridge_agrees(const struct couple *c, const double a[16], const double b[16])
{
	for (int k = 0; k < 8; k++) {
		double p[4], q[4], off = 0, far = c->size;

		matrix_transform(p, a, c->corner[k]);
		matrix_transform(q, b, c->corner[k]);
		for (int i = 0; i < 3; i++) {
			off = fmax(off, fabs(p[i] - q[i]));
			far = fmax(far, fmax(fabs(c->corner[k][i]), fabs(p[i])));
		}
		if (!(off <= BRIDGE_SAME * far))
			return 0;
	}
	return 1;
}

int bridge_is_filmed(const struct bridge *b, uint32_t i)
{
	const struct scene_view *view = &b->base->views[b->base->instances[i].view];

	return b->camera && view->space == b->camera->space && !view->target && !drawn_in_parallel(view);
}

const double *bridge_way(const struct bridge *b, const struct motion *m)
{
	return b->is_back ? m->back : m->motion;
}

int bridge_may_be_one(const struct bridge *b, uint32_t i, uint32_t other)
{
	const struct scene *s = b->base, *t = b->other;
	const struct scene_mesh *mesh = s->meshes[s->instances[i].mesh], *was = t->meshes[t->instances[other].mesh];
	const struct scene_view *view = &s->views[s->instances[i].view];

	if (view->target != t->views[t->instances[other].view].target)
		return 0;
	return mixed_same_points(mesh, was) ||
	       (s->materials[s->instances[i].material].depth_test && mixed_suits(mesh, was));
}

void bridge_end(struct bridge *b)
{
	free(b->couples);
	free(b->boxes);
	free(b->motions);
}
