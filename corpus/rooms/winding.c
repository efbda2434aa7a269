/* Convex polygons: cutting, area, plane, box. */
#include "winding.h"

#include <stddef.h>

struct winding winding_of_plane(struct plane plane)
{
	struct vec u, v, centre = vec_scale(plane.n, plane.d);
	const double far = 4096;

	vec_frame(plane.n, &u, &v);
	return (struct winding){ 4, { vec_mad(vec_mad(centre, u, -far), v, -far), vec_mad(vec_mad(centre, u, far), v, -far),
	                              vec_mad(vec_mad(centre, u, far), v, far), vec_mad(vec_mad(centre, u, -far), v, far) } };
}

static void add_point(struct winding *w, struct vec p)
{
	if (w->n < WINDING_MAX)
		w->p[w->n++] = p;
}

int winding_split(const struct winding *w, struct plane plane, struct winding *front, struct winding *back)
{
	struct winding side[2] = { { .n = 0 }, { .n = 0 } };
	int there[2] = { 0, 0 };

	for (int i = 0; i < w->n; i++) {
		struct vec a = w->p[i], b = w->p[(i + 1) % w->n];
		double da = plane_distance(plane, a), db = plane_distance(plane, b);

		there[da < 0] |= fabs(da) > ON_PLANE;
		if (da > -ON_PLANE)
			add_point(&side[0], a);
		if (da < ON_PLANE)
			add_point(&side[1], a);
		if (fmin(da, db) < -ON_PLANE && fmax(da, db) > ON_PLANE) {
			struct vec cut = vec_mad(a, vec_sub(b, a), da / (da - db));

			add_point(&side[0], cut);
			add_point(&side[1], cut);
		}
	}
	for (int k = 0; k < 2; k++)
		if (!there[k])
			side[k].n = 0;
	if (front)
		*front = side[0];
	if (back)
		*back = side[1];
	return there[0] && there[1];
}

struct winding winding_reverse(const struct winding *w)
{
	struct winding out = { .n = w->n };

	for (int i = 0; i < w->n; i++)
		out.p[i] = w->p[w->n - 1 - i];
	return out;
}

struct vec winding_centre(const struct winding *w)
{
	struct vec sum = vec(0, 0, 0);

	for (int i = 0; i < w->n; i++)
		sum = vec_add(sum, w->p[i]);
	return vec_scale(sum, 1.0 / w->n);
}

/* Twice the area, along the normal (Newell). */
static struct vec winding_cross(const struct winding *w)
{
	struct vec sum = vec(0, 0, 0);

	for (int i = 1; i + 1 < w->n; i++)
		sum = vec_add(sum, vec_cross(vec_sub(w->p[i], w->p[0]), vec_sub(w->p[i + 1], w->p[0])));
	return sum;
}

double winding_area(const struct winding *w)
{
	return w->n < 3 ? 0 : 0.5 * vec_length(winding_cross(w));
}

struct plane winding_plane(const struct winding *w)
{
	struct vec n = vec_unit(winding_cross(w));

	return (struct plane){ n, vec_dot(n, winding_centre(w)) };
}

struct box winding_box(const struct winding *w)
{
	struct box box = box_empty();

	for (int i = 0; i < w->n; i++)
		box_add(&box, w->p[i]);
	return box;
}
