/* Welds, merges and repairs the polygons of a level. */
#include "mesh.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"

/* --- Points ------------------------------------------------------------------------------------------------------ */

/*
 * Points are found by their grid cell, CELL wide, in a hash table with linear probing (mesh->cells). A point within
 * WELD of a place may lie in another cell, but then that cell contains a corner of the cube, 2 WELD wide, around the
 * place.
 */
#define CELL (16 * WELD)

/* The slot of the table where a search for the points of a place's cell begins. */
static size_t first_slot(const struct mesh *mesh, double x, double y, double z)
{
	uint64_t h = (uint64_t)(int64_t)floor(x / CELL) * 0x9E3779B97F4A7C15u;

	h = (h ^ (uint64_t)(int64_t)floor(y / CELL)) * 0xC2B2AE3D27D4EB4Fu;
	h = (h ^ (h >> 29) ^ (uint64_t)(int64_t)floor(z / CELL)) * 0x165667B19E3779F9u;
	return (size_t)(h ^ (h >> 32)) & (mesh->n_cells - 1);
}

/* The table must have room. */
static void insert_point(struct mesh *mesh, unsigned point)
{
	struct vec p = mesh->points[point];
	size_t i = first_slot(mesh, p.x, p.y, p.z);

	while (mesh->cells[i])
		i = (i + 1) & (mesh->n_cells - 1);
	mesh->cells[i] = point + 1;
}

/* Make room for another point: at most half of the slots are in use. */
static void grow_table(struct mesh *mesh)
{
	if (2 * mesh->n_points < mesh->n_cells)
		return;
	free(mesh->cells);
	mesh->n_cells = mesh->n_cells ? 2 * mesh->n_cells : 1024;
	mesh->cells = calloc(mesh->n_cells, sizeof(*mesh->cells));
	if (!mesh->cells)
		exit(1);
	for (unsigned i = 0; i < mesh->n_points; i++)
		insert_point(mesh, i);
}

/* The point at a place, created if there is none within WELD. */
static unsigned find_point(struct mesh *mesh, struct vec p)
{
	grow_table(mesh);
	for (int corner = 0; corner < 8; corner++) {
		size_t i = first_slot(mesh, p.x + (corner & 1 ? WELD : -WELD), p.y + (corner & 2 ? WELD : -WELD),
		                      p.z + (corner & 4 ? WELD : -WELD));

		for (; mesh->cells[i]; i = (i + 1) & (mesh->n_cells - 1))
			if (vec_length(vec_sub(mesh->points[mesh->cells[i] - 1], p)) < WELD)
				return mesh->cells[i] - 1;
	}
	ARRAY_PUSH(mesh->points, mesh->n_points, p);
	insert_point(mesh, (unsigned)mesh->n_points - 1);
	return (unsigned)mesh->n_points - 1;
}

/* --- Faces ------------------------------------------------------------------------------------------------------- */

void mesh_add(struct mesh *mesh, const struct winding *w, struct plane plane, int texture, int portal)
{
	struct face face = { .plane = plane, .texture = texture, .portal = portal };
	size_t n = 0;

	for (int i = 0; i < w->n; i++) {
		unsigned point = find_point(mesh, w->p[i]);

		if (!n || (face.v[n - 1] != point && face.v[0] != point))
			ARRAY_PUSH(face.v, n, point);
	}
	face.n = (unsigned)n;
	if (n < 3)
		free(face.v);
	else
		ARRAY_PUSH(mesh->faces, mesh->n_faces, face);
}

void mesh_sweep(struct mesh *mesh)
{
	size_t n = 0;

	for (size_t i = 0; i < mesh->n_faces; i++)
		if (mesh->faces[i].n)
			mesh->faces[n++] = mesh->faces[i];
		else
			free(mesh->faces[i].v);
	mesh->n_faces = n;
}

struct winding mesh_winding(const struct mesh *mesh, const struct face *face)
{
	struct winding w = { .n = 0 };

	for (unsigned i = 0; i < face->n && w.n < WINDING_MAX; i++)
		w.p[w.n++] = mesh->points[face->v[i]];
	return w;
}

/* --- Merging ----------------------------------------------------------------------------------------------------- */

/* Sine of the turn at a corner, seen from the front: positive to the left, 0 straight on. */
static double turn_at(const struct mesh *mesh, const struct face *face, unsigned i)
{
	struct vec a = mesh->points[face->v[(i + face->n - 1) % face->n]], b = mesh->points[face->v[i]];
	struct vec c = mesh->points[face->v[(i + 1) % face->n]];

	return vec_dot(face->plane.n, vec_cross(vec_unit(vec_sub(b, a)), vec_unit(vec_sub(c, b))));
}

static void drop_straight_corners(const struct mesh *mesh, struct face *face)
{
	for (unsigned i = 0; face->n > 3 && i < face->n;)
		if (fabs(turn_at(mesh, face, i)) < WELD)
			memmove(&face->v[i], &face->v[i + 1], (--face->n - i) * sizeof(*face->v));
		else
			i++;
}

/*
 * Join two polygons along a shared edge: a's corners i and i + 1, which are b's corners k + 1 and k.
 * @return 1: joined in a, and b has no corners left; 0: the result would not be convex, and nothing has changed
 */
static int join_faces(const struct mesh *mesh, struct face *a, unsigned i, struct face *b, unsigned k)
{
	struct face joined = { .plane = a->plane, .texture = a->texture, .portal = a->portal };
	size_t n = 0;

	for (unsigned c = 1; c <= a->n; c++) /* from the edge's end around to its start */
		ARRAY_PUSH(joined.v, n, a->v[(i + c) % a->n]);
	for (unsigned c = 2; c < b->n; c++)
		ARRAY_PUSH(joined.v, n, b->v[(k + c) % b->n]);
	joined.n = (unsigned)n;
	drop_straight_corners(mesh, &joined);
	for (unsigned c = 0; c < joined.n; c++)
		if (turn_at(mesh, &joined, c) < 0) {
			free(joined.v);
			return 0;
		}
	free(a->v);
	*a = joined;
	b->n = 0;
	return 1;
}

/* 1 if two faces are alike and in one plane; they need not touch. */
static int can_join(const struct face *a, const struct face *b)
{
	return b->n && a->texture == b->texture && a->portal == b->portal && vec_dot(a->plane.n, b->plane.n) > 1 - 1e-9 &&
	       fabs(a->plane.d - b->plane.d) < WELD;
}

/* Join a face with one neighbour. @return 1 if there was one to join */
static int grow_face(struct mesh *mesh, size_t which)
{
	struct face *a = &mesh->faces[which];

	for (size_t other = 0; other < mesh->n_faces; other++) {
		struct face *b = &mesh->faces[other];

		if (other == which || !can_join(a, b))
			continue;
		for (unsigned i = 0; i < a->n; i++)
			for (unsigned k = 0; k < b->n; k++)
				if (a->v[i] == b->v[(k + 1) % b->n] && a->v[(i + 1) % a->n] == b->v[k] && join_faces(mesh, a, i, b, k))
					return 1;
	}
	return 0;
}

void mesh_merge(struct mesh *mesh)
{
	for (size_t i = 0; i < mesh->n_faces; i++)
		while (mesh->faces[i].n && grow_face(mesh, i))
			continue;
	mesh_sweep(mesh);
}

/* --- T-junctions ------------------------------------------------------------------------------------------------- */

/* Find the first point between the ends of an edge. @return 1 if there is one */
static int point_between(const struct mesh *mesh, unsigned from, unsigned to, unsigned *out)
{
	struct vec a = mesh->points[from], d = vec_sub(mesh->points[to], a);
	double length = vec_length(d), nearest = length - WELD;
	int found = 0;

	d = vec_scale(d, 1 / length);
	for (unsigned i = 0; i < mesh->n_points; i++) {
		struct vec p = vec_sub(mesh->points[i], a);
		double along = vec_dot(p, d);

		if (along > WELD && along < nearest && vec_length(vec_mad(p, d, -along)) < WELD) {
			nearest = along;
			*out = i;
			found = 1;
		}
	}
	return found;
}

/* Drop points that belong to no face. */
static void drop_unused_points(struct mesh *mesh)
{
	unsigned *number = calloc(mesh->n_points + 1, sizeof(*number)); /* 1: the point is used; then its new number */
	unsigned n = 0;

	if (!number)
		exit(1);
	for (size_t i = 0; i < mesh->n_faces; i++)
		for (unsigned k = 0; k < mesh->faces[i].n; k++)
			number[mesh->faces[i].v[k]] = 1;
	for (size_t i = 0; i < mesh->n_points; i++)
		if (number[i]) {
			mesh->points[n] = mesh->points[i];
			number[i] = n++;
		}
	for (size_t i = 0; i < mesh->n_faces; i++)
		for (unsigned k = 0; k < mesh->faces[i].n; k++)
			mesh->faces[i].v[k] = number[mesh->faces[i].v[k]];
	mesh->n_points = n;
	free(number);
	free(mesh->cells);
	mesh->cells = NULL;
	mesh->n_cells = 0; /* no point is looked up after this */
}

void mesh_repair(struct mesh *mesh)
{
	drop_unused_points(mesh);
	for (size_t i = 0; i < mesh->n_faces; i++) {
		struct face *face = &mesh->faces[i];

		for (unsigned k = 0; k < face->n; k++) {
			unsigned between;

			if (!point_between(mesh, face->v[k], face->v[(k + 1) % face->n], &between))
				continue;
			/* The next k tests the rest of this edge. */
			face->v = realloc(face->v, (face->n + 1) * sizeof(*face->v));
			if (!face->v)
				exit(1);
			memmove(&face->v[k + 2], &face->v[k + 1], (face->n - k - 1) * sizeof(*face->v));
			face->v[k + 1] = between;
			face->n++;
		}
	}
}

size_t mesh_count_t_junctions(const struct mesh *mesh)
{
	size_t n = 0;
	unsigned between;

	for (size_t i = 0; i < mesh->n_faces; i++)
		for (unsigned k = 0; k < mesh->faces[i].n; k++)
			n += (size_t)point_between(mesh, mesh->faces[i].v[k], mesh->faces[i].v[(k + 1) % mesh->faces[i].n], &between);
	return n;
}

void mesh_free(struct mesh *mesh)
{
	for (size_t i = 0; i < mesh->n_faces; i++)
		free(mesh->faces[i].v);
	free(mesh->faces);
	free(mesh->points);
	free(mesh->cells);
	*mesh = (struct mesh){ .n_faces = 0 };
}
