/*
 * The surface of a level: convex polygons on shared points, facing empty space. Lengths are metres.
 *
 * Built by these steps, in order: csg_build, mesh_merge, portals_cut, mesh_repair; then zones_find. Running out of
 * memory ends the program.
 */
#pragma once

#include <stddef.h>

#include "winding.h"

/* Points closer than this are one. */
#define WELD 1e-4

enum { NO_PORTAL = -1 };

struct face {
	unsigned *v; /* owned: numbers of its points, counter-clockwise seen from the front */
	unsigned n;
	struct plane plane;
	int texture;
	int portal;    /* number of the portal that it belongs to; NO_PORTAL: a wall. A portal has a face for each side */
	unsigned zone; /* number of the zone in front of it, set by zones_find */
};

struct mesh {
	struct vec *points;
	size_t n_points;
	struct face *faces;
	size_t n_faces;
	unsigned *cells; /* hash table from places to points: 1 + a point's number; 0: an empty slot */
	size_t n_cells;  /* its slots, a power of two; 0: no table yet, or no longer */
};

/** Add a face. Its corners are welded to existing points; a face that collapses is dropped. */
void mesh_add(struct mesh *mesh, const struct winding *w, struct plane plane, int texture, int portal);

/** Remove faces without corners, left by earlier steps. */
void mesh_sweep(struct mesh *mesh);

/** Join neighbours in one plane with one texture if the resulting polygon is convex. */
void mesh_merge(struct mesh *mesh);

/**
 * Drop unused points. Then insert points that lie on an edge, between its ends, into the polygon, so that no T-junction
 * is left. No face can be added afterwards.
 */
void mesh_repair(struct mesh *mesh);

/** Number of edges with a point between their ends. */
size_t mesh_count_t_junctions(const struct mesh *mesh);

/** A face as a polygon with points of its own. */
struct winding mesh_winding(const struct mesh *mesh, const struct face *face);

void mesh_free(struct mesh *mesh);
