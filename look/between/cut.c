/* Finds cuts: samples the surface of one frame, and looks for each point in the other. */
#include "look/between/bridge.h"

#include <math.h>

#include "look/draws/matrix.h"

#define ALL_POINTS 32768u /* samples in a frame */
#define MOST_POINTS 4096u /* samples in a triangle, at most */
#define FAR 1.0           /* half the picture's width: the eye does not follow what moves faster than this per frame */
#define MOST_AREA 0.01    /* largest area of a point in the picture: a hundredth of a square half as wide as the
                             picture */

/* A draw in one frame. */
struct shown {
	const struct scene_mesh *mesh;
	double eye[16], projection[16]; /* eye: the modelview */
};

static struct shown shown_of(const struct scene *s, uint32_t instance)
{
	const struct scene_instance *in = &s->instances[instance];
	struct shown d = { .mesh = s->meshes[in->mesh] };

	matrix_from_floats(d.eye, in->modelview);
	matrix_from_floats(d.projection, s->views[in->view].projection);
	return d;
}

/* Transform a triangle to clip space: its first corner, and the two edges from it. */
static void place(const struct shown *d, uint32_t triangle, double corner[4], double edge[2][4])
{
	double at[3][4];

	for (int k = 0; k < 3; k++) {
		const float *v = d->mesh->position + 4 * (size_t)d->mesh->index[3 * (size_t)triangle + (size_t)k];
		const double object[4] = { (double)v[0], (double)v[1], (double)v[2], (double)v[3] };
		double seen[4];

		matrix_transform(seen, d->eye, object);
		matrix_transform(at[k], d->projection, seen);
	}
	for (int i = 0; i < 4; i++) {
		corner[i] = at[0][i];
		edge[0][i] = at[1][i] - at[0][i];
		edge[1][i] = at[2][i] - at[0][i];
	}
}

/*
 * Project the point (u, v) of a triangle to the picture, which is 2 wide and 2 high.
 * @param area  receives the triangle's area in the picture, as if the scale at this point applied to all of it
 * @return 0: the point is behind the viewer
 */
static int show(const double corner[4], const double edge[2][4], double u, double v, double out[2], double *area)
{
	double at[4], along[2][2];

	for (int i = 0; i < 4; i++)
		at[i] = corner[i] + u * edge[0][i] + v * edge[1][i];
	if (!(at[3] > 0))
		return 0;
	for (int i = 0; i < 2; i++) {
		out[i] = at[i] / at[3];
		for (int k = 0; k < 2; k++)
			along[k][i] = (edge[k][i] - out[i] * edge[k][3]) / at[3];
	}
	*area = fabs(along[0][0] * along[1][1] - along[0][1] * along[1][0]) / 2;
	return 1;
}

/* Point k of n evenly distributed points in a triangle (like the plain samples of kernels/frame/light/sample.h). */
static void point_of(uint32_t k, double *u, double *v)
{
	*u = fmod(0.5 + k * 0.75487766624669276, 1);
	*v = fmod(0.5 + k * 0.56984029099805327, 1);
	if (*u + *v > 1) {
		*u = 1 - *u;
		*v = 1 - *v;
	}
}

/*
 * Add up the visible area of a triangle, from n samples.
 * @param was   the same draw in the other frame; NULL: it is not there
 * @param all   raised by the area inside the picture
 * @param kept  raised by the part of it that the other frame shows at most FAR away
 */
static void compare(const struct shown *now, const struct shown *was, uint32_t triangle, uint32_t n, double *all,
                    double *kept)
{
	double corner[4], edge[2][4], old_corner[4], old_edge[2][4];

	place(now, triangle, corner, edge);
	if (was)
		place(was, triangle, old_corner, old_edge);
	for (uint32_t k = 0; k < n; k++) {
		double u, v, here[2], there[2], area, old_area;

		point_of(k, &u, &v);
		if (!show(corner, (const double (*)[4])edge, u, v, here, &area) || !(fabs(here[0]) <= 1 && fabs(here[1]) <= 1))
			continue;
		area = fmin(MOST_AREA, area / n);
		*all += area;
		if (was && show(old_corner, (const double (*)[4])old_edge, u, v, there, &old_area) &&
		    fmax(fabs(here[0] - there[0]), fabs(here[1] - there[1])) <= FAR)
			*kept += area;
	}
}

/* 1 for draws that count: depth-tested triangles in the window, not placed by a vertex program. */
static int counts(const struct scene *s, uint32_t i)
{
	const struct scene_instance *in = &s->instances[i];

	return s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle && s->materials[in->material].depth_test &&
	       !s->materials[in->material].vertex_program && !s->views[in->view].target;
}

int bridge_is_cut(const struct bridge *b)
{
	const struct scene *s = b->base;
	uint64_t n_triangles = 1, most;
	double all = 0, kept = 0;

	for (uint32_t i = 0; i < s->n_instances; i++)
		n_triangles += counts(s, i) ? s->meshes[s->instances[i].mesh]->primitive_count : 0;
	most = ALL_POINTS / n_triangles + 1;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct shown now = shown_of(s, i);
		const uint32_t other = b->couples[i].other, step = (uint32_t)(n_triangles / ALL_POINTS) + 1,
		               n = (uint32_t)(most < MOST_POINTS ? most : MOST_POINTS);
		struct shown was;

		if (!counts(s, i))
			continue;
		if (other != SCENE_NONE)
			was = shown_of(b->other, other);
		for (uint32_t t = 0; t < now.mesh->primitive_count; t += step)
			compare(&now, other != SCENE_NONE && t < was.mesh->primitive_count ? &was : NULL, t, n, &all, &kept);
	}
	return kept < all / 2;
}
