/* A mesh under repair: triangles between places; vertices only hold the attributes of corners. */
#pragma once

#include <stddef.h>

#include "scene/repair/repair.h"

struct shape_face {
	uint32_t v[3]; /* vertices: of the mesh, then of `made` */
	uint32_t p[3]; /* places; all three are SCENE_NONE if a corner is NaN or infinite */
	uint32_t from; /* the mesh's primitive that it is or is part of */
};

/* A new vertex between two. */
struct shape_made {
	uint32_t a, b, point;
	float at;      /* from a (0) to b (1) */
	uint32_t like; /* the vertex whose colour it takes under flat shading */
};

struct shape {
	const struct scene_mesh *mesh;
	const struct repair_wants *wants;
	struct repair_found *found;
	double size, tolerance; /* length of the box's diagonal; distance below which places are one */
	double (*points)[3];
	uint32_t n_points;
	uint32_t *point_of; /* [mesh->vertex_count]; SCENE_NONE: NaN or infinite, or in no triangle */
	struct shape_face *faces;
	size_t n_faces, room_faces;
	struct shape_made *made;
	size_t n_made, room_made;
};

/* An edge of a face; a < b are its places. */
struct shape_edge {
	uint32_t a, b;
	uint32_t use; /* 3 x face + the corner where it starts */
};

/* Location of a mesh's attribute array, and its numbers for each vertex. */
struct shape_attribute {
	const float **array;
	size_t each;
	int is_color; /* 1: under flat shading a triangle has one value */
};

enum { SHAPE_MOST_ATTRIBUTES = 5 + SCENE_MAX_UNITS + SCENE_MAX_GENERICS };

/** List all arrays of a mesh but its positions. @return their number */
size_t shape_list_attributes(struct scene_mesh *mesh, struct shape_attribute list[SHAPE_MOST_ATTRIBUTES]);

/** Set up triangles and welded places. @return 0 or ERR_SYSTEM (reported); shape_free in any case */
int shape_init(struct shape *s, const struct scene_mesh *mesh, const struct repair_wants *wants,
               struct repair_found *found);
void shape_free(struct shape *s);

/** List all edges of faces that have places, equal ones side by side. @return 0 or ERR_SYSTEM (reported) */
int shape_list_edges(const struct shape *s, struct shape_edge **edges, size_t *n);

/** The end of the run of equal edges that begins at `first`. balance: number that run from a to b, less those from b to
 * a */
size_t shape_run_end(const struct shape *s, const struct shape_edge *edges, size_t n, size_t first, int *balance);

/** Drop marked faces. marks: [n_faces], not 0: drop */
void shape_drop(struct shape *s, const uint8_t *marks);

/** Normal to the side where the face is seen counter-clockwise, twice the area long. @return its length */
double shape_normal(const struct shape *s, const struct shape_face *face, double out[3]);
