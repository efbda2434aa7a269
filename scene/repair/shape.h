/* A mesh under repair: triangles between places, where vertices only say what a corner looks like. */
#pragma once

#include <stddef.h>

#include "scene/repair/repair.h"

struct shape_face {
	uint32_t v[3]; /* vertices: the mesh's, then `made` */
	uint32_t p[3]; /* places; SCENE_NONE where a corner is no number: then all three are */
	uint32_t from; /* the mesh's primitive that it is, or is part of */
};

/* A vertex between two. */
struct shape_made {
	uint32_t a, b, point;
	float at;      /* from a (0) to b (1) */
	uint32_t like; /* the vertex whose colour it takes under flat shading */
};

struct shape {
	const struct scene_mesh *mesh;
	const struct repair_wants *wants;
	struct repair_found *found;
	double size, tolerance; /* of the box's diagonal; the distance that counts as none */
	double (*points)[3];
	uint32_t n_points;
	uint32_t *point_of; /* [mesh->vertex_count]; SCENE_NONE: no number, or no triangle's */
	struct shape_face *faces;
	size_t n_faces, room_faces;
	struct shape_made *made;
	size_t n_made, room_made;
};

/* An edge of a face; a < b are its places. */
struct shape_edge {
	uint32_t a, b;
	uint32_t use; /* 3 x face + the corner that it leaves */
};

/* Where an array of a mesh is, and how many numbers a vertex has. */
struct shape_attribute {
	const float **array;
	size_t each;
	int is_color; /* 1: flat shading takes one for all of a triangle */
};

enum { SHAPE_MOST_ATTRIBUTES = 5 + SCENE_MAX_UNITS + SCENE_MAX_GENERICS };

/** All arrays but positions that a mesh has. @return how many */
size_t shape_list_attributes(struct scene_mesh *mesh, struct shape_attribute list[SHAPE_MOST_ATTRIBUTES]);

/** Triangles and places, each place welded. @return 0 or ERR_SYSTEM (reported); shape_free in any case */
int shape_init(struct shape *s, const struct scene_mesh *mesh, const struct repair_wants *wants,
               struct repair_found *found);
void shape_free(struct shape *s);

/** All edges of faces that have places, equal ones side by side. @return 0 or ERR_SYSTEM (reported) */
int shape_list_edges(const struct shape *s, struct shape_edge **edges, size_t *n);

/** The end of the run of equal edges that begins at `first`. balance: those that run from a to b, less those from b to
 * a */
size_t shape_run_end(const struct shape *s, const struct shape_edge *edges, size_t n, size_t first, int *balance);

/** Drop marked faces. marks: [n_faces], not 0: marked */
void shape_drop(struct shape *s, const uint8_t *marks);

/** Twice the area as a normal, to the side from which the face is seen counter-clockwise. @return its length */
double shape_normal(const struct shape *s, const struct shape_face *face, double out[3]);
