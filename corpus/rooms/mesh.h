/*
 * The surface of a level: convex polygons on shared points, their fronts towards what is empty.
 *
 * It is made in steps, in this order: csg_build, mesh_merge, portals_cut, mesh_repair; then zones_find.
 */
#pragma once

#include <stddef.h>

#include "winding.h"

/* Points nearer than this are one. */
#define WELD 1e-4

enum { NO_PORTAL = -1 };

struct face {
	unsigned *v; /* owned: points, counter-clockwise from the front */
	unsigned n;
	struct plane plane;
	int texture;
	int portal;    /* its number; NO_PORTAL: it is a wall. A portal has two faces, one for each side. */
	unsigned zone; /* in front of it */
};

struct mesh {
	struct vec *points;
	size_t n_points;
	struct face *faces;
	size_t n_faces;
	unsigned *cells; /* hash table from places to points, n + 1; 0: empty */
	size_t n_cells;
};

/** Add a face. Its corners are welded to points that are there; a face that this collapses is left out. */
void mesh_add(struct mesh *mesh, const struct winding *w, struct plane plane, int texture, int portal);

/** Remove faces without corners, which steps leave behind. */
void mesh_sweep(struct mesh *mesh);

/** Join neighbours in one plane, of one texture, wherever the polygon that results is convex. */
void mesh_merge(struct mesh *mesh);

/** Insert points that lie on an edge between its ends into the polygon: no T-junction is left. */
void mesh_repair(struct mesh *mesh);

/** How many points lie on edges between their ends. */
size_t mesh_count_t_junctions(const struct mesh *mesh);

struct winding mesh_winding(const struct mesh *mesh, const struct face *face);

void mesh_free(struct mesh *mesh);
