/*
 * The surface of a level: convex polygons on shared points, facing empty space.
 *
 * Built by these steps, in order: csg_build, mesh_merge, portals_cut, mesh_repair; then zones_find.
 */
#pragma once

#include <stddef.h>

#include "winding.h"

/* Points closer than this are one. */
#define WELD 1e-4

enum { NO_PORTAL = -1 };

struct face {
	unsigned *v; /* owned: points, counter-clockwise from the front */
	unsigned n;
	struct plane plane;
	int texture;
	int portal;    /* its number; NO_PORTAL: a wall. A portal has two faces, one for each side. */
	unsigned zone; /* in front of it */
};

struct mesh {
	struct vec *points;
	size_t n_points;
	struct face *faces;
	size_t n_faces;
	unsigned *cells; /* hash table from places to points, as n + 1; 0: empty */
	size_t n_cells;
};

/** Add a face. Its corners are welded to existing points; a face that collapses is dropped. */
void mesh_add(struct mesh *mesh, const struct winding *w, struct plane plane, int texture, int portal);

/** Remove faces without corners, left by earlier steps. */
void mesh_sweep(struct mesh *mesh);

/** Join neighbours in one plane with one texture if the resulting polygon is convex. */
void mesh_merge(struct mesh *mesh);

/** Insert points that lie on an edge between its ends into the polygon, so that no T-junction is left. */
void mesh_repair(struct mesh *mesh);

/** Number of points on edges between their ends. */
size_t mesh_count_t_junctions(const struct mesh *mesh);

struct winding mesh_winding(const struct mesh *mesh, const struct face *face);

void mesh_free(struct mesh *mesh);
