/* Computes a level's surface, and its portals. */
#include "csg.h"

#include <math.h>
#include <stdlib.h>

#include "array.h"

/* Distance from a polygon where its two sides are sampled. */
#define BESIDE 1e-3
/* Smaller polygons are slivers from rounding. */
#define MIN_AREA 1e-6

struct windings {
	struct winding *items;
	size_t n;
};

/* Cut windings by a brush: into the part inside it, and the parts in front of each plane in turn. */
static void cut_by_brush(struct windings *list, const struct brush *b)
{
	size_t n = list->n;

	for (size_t i = 0; i < n; i++) {
		struct winding rest = list->items[i], front;

		if (!box_meets(winding_box(&rest), b->box, BESIDE))
			continue;
		for (int k = 0; k < b->n_planes; k++) {
			struct winding was = rest;

			if (winding_split(&was, b->planes[k], &front, &rest)) {
				ARRAY_PUSH(list->items, list->n, front);
			} else if (!rest.n) { /* all of it is in front, or in the plane and still to be cut by the others */
				rest = was;
				if (front.n)
					break;
			}
		}
		list->items[i] = rest;
	}
}

/* 1 if a later brush also has a side here, and so makes the same polygon. */
static int is_made_later(const struct level *level, size_t brush, struct plane plane, struct vec centre)
{
	for (size_t i = brush + 1; i < level->n_brushes; i++) {
		const struct brush *b = &level->brushes[i];
		int side = 0, inside = 1;

		for (int k = 0; k < b->n_planes; k++) {
			side |= fabs(fabs(vec_dot(b->planes[k].n, plane.n)) - 1) < 1e-9 &&
			        fabs(plane_distance(b->planes[k], centre)) < ON_PLANE;
			inside &= plane_distance(b->planes[k], centre) < ON_PLANE;
		}
		if (side && inside)
			return 1;
	}
	return 0;
}

static struct winding side_of_brush(const struct brush *b, int side)
{
	struct winding w = winding_of_plane(b->planes[side]);

	for (int k = 0; k < b->n_planes && w.n; k++)
		if (k != side)
			winding_split(&w, b->planes[k], NULL, &w);
	return w;
}

/* Add the parts of a brush's side that are surface, facing empty space. */
static void add_surface(const struct level *level, size_t brush, struct plane plane, const struct winding *w,
                        struct mesh *mesh)
{
	struct vec centre = winding_centre(w);
	int front, back;

	if (winding_area(w) < MIN_AREA)
		return;
	front = level_is_solid(level, vec_mad(centre, plane.n, BESIDE));
	back = level_is_solid(level, vec_mad(centre, plane.n, -BESIDE));
	if (front == back || is_made_later(level, brush, plane, centre))
		return;
	if (front) {
		struct winding turned = winding_reverse(w);

		mesh_add(mesh, &turned, plane_flip(plane), level->brushes[brush].texture, NO_PORTAL);
	} else {
		mesh_add(mesh, w, plane, level->brushes[brush].texture, NO_PORTAL);
	}
}

void csg_build(const struct level *level, struct mesh *mesh)
{
	for (size_t i = 0; i < level->n_brushes; i++) {
		const struct brush *b = &level->brushes[i];

		for (int side = 0; side < b->n_planes; side++) {
			struct windings list = { .n = 0 };
			struct winding whole = side_of_brush(b, side);

			if (!whole.n)
				continue;
			ARRAY_PUSH(list.items, list.n, whole);
			for (size_t k = 0; k < level->n_brushes; k++)
				if (k != i)
					cut_by_brush(&list, &level->brushes[k]);
			for (size_t k = 0; k < list.n; k++)
				add_surface(level, i, b->planes[side], &list.items[k], mesh);
			free(list.items);
		}
	}
}

/* --- Portals ----------------------------------------------------------------------------------------------------- */

/* Add two faces for each piece of a portal outside walls. */
static void add_portal(const struct level *level, size_t portal, struct mesh *mesh)
{
	struct windings list = { .n = 0 };
	struct plane plane = winding_plane(&level->portals[portal]);

	ARRAY_PUSH(list.items, list.n, level->portals[portal]);
	for (size_t k = 0; k < level->n_brushes; k++)
		cut_by_brush(&list, &level->brushes[k]);
	for (size_t k = 0; k < list.n; k++) {
		struct winding turned = winding_reverse(&list.items[k]);

		if (winding_area(&turned) < MIN_AREA || level_is_solid(level, vec_mad(winding_centre(&turned), plane.n, BESIDE)) ||
		    level_is_solid(level, vec_mad(winding_centre(&turned), plane.n, -BESIDE)))
			continue;
		mesh_add(mesh, &list.items[k], plane, 0, (int)portal);
		mesh_add(mesh, &turned, plane_flip(plane), 0, (int)portal);
	}
	free(list.items);
}

/* 1 if a wall meets a portal's plane along the portal's rim. */
static int meets_rim(const struct mesh *mesh, const struct winding *wall, const struct face *portal)
{
	struct winding front;
	struct vec ends[2];
	int n = 0;

	winding_split(wall, portal->plane, &front, NULL);
	for (int i = 0; i < front.n && n < 2; i++)
		if (fabs(plane_distance(portal->plane, front.p[i])) < ON_PLANE)
			ends[n++] = front.p[i];
	for (unsigned i = 0; n == 2 && i < portal->n; i++) {
		struct vec a = mesh->points[portal->v[i]], d = vec_sub(mesh->points[portal->v[(i + 1) % portal->n]], a);
		double length = vec_length(d), from, to;

		d = vec_scale(d, 1 / length);
		from = vec_dot(vec_sub(ends[0], a), d);
		to = vec_dot(vec_sub(ends[1], a), d);
		if (vec_length(vec_sub(vec_sub(ends[0], a), vec_scale(d, from))) < WELD &&
		    vec_length(vec_sub(vec_sub(ends[1], a), vec_scale(d, to))) < WELD &&
		    fmin(fmax(from, to), length) - fmax(fmin(from, to), 0) > WELD)
			return 1;
	}
	return 0;
}

/* Cut the walls that meet a portal's rim in two, along its plane. portal: the number of its face */
static void cut_walls(struct mesh *mesh, size_t portal)
{
	size_t n = mesh->n_faces;

	for (size_t i = 0; i < n; i++) {
		struct winding wall = mesh_winding(mesh, &mesh->faces[i]), front, back;
		struct face was = mesh->faces[i];

		if (was.portal != NO_PORTAL || !winding_split(&wall, mesh->faces[portal].plane, &front, &back) ||
		    !meets_rim(mesh, &wall, &mesh->faces[portal]))
			continue;
		mesh->faces[i].n = 0;
		mesh_add(mesh, &front, was.plane, was.texture, NO_PORTAL);
		mesh_add(mesh, &back, was.plane, was.texture, NO_PORTAL);
	}
}

void portals_cut(const struct level *level, struct mesh *mesh)
{
	size_t end;

	for (size_t i = 0; i < level->n_portals; i++)
		add_portal(level, i, mesh);
	mesh_merge(mesh);
	end = mesh->n_faces;
	for (size_t i = 0; i < end; i++)
		if (mesh->faces[i].portal != NO_PORTAL)
			cut_walls(mesh, i);
	mesh_sweep(mesh);
}
