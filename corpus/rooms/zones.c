/* Finds zones by walking over edges. */
#include "zones.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "array.h"

/* --- Edges ------------------------------------------------------------------------------------------------------- */

struct edge {
	uint64_t key; /* start and end */
	unsigned face, corner;
};

static uint64_t key_of(unsigned from, unsigned to)
{
	return (uint64_t)from << 32 | to;
}

static int compare_edges(const void *a, const void *b)
{
	const struct edge *x = a, *y = b;

	return x->key != y->key ? (x->key < y->key ? -1 : 1) : (x->face > y->face) - (x->face < y->face);
}

static struct edge *list_edges(const struct mesh *mesh, size_t *n)
{
	struct edge *edges = NULL;

	*n = 0;
	for (unsigned f = 0; f < mesh->n_faces; f++)
		for (unsigned k = 0; k < mesh->faces[f].n; k++)
			ARRAY_PUSH(edges, *n,
			           ((struct edge){
					   key_of(mesh->faces[f].v[k], mesh->faces[f].v[(k + 1) % mesh->faces[f].n]), f,
					   k }));
	if (*n)
		qsort(edges, *n, sizeof(*edges), compare_edges);
	return edges;
}

static const struct edge *first_edge(const struct edge *edges, size_t n, uint64_t key)
{
	size_t low = 0, high = n;

	while (low < high) {
		size_t middle = (low + high) / 2;

		if (edges[middle].key < key)
			low = middle + 1;
		else
			high = middle;
	}
	return &edges[low];
}

/*
 * Angle about an edge from one face, through the empty space in front of it, to another face that runs along the edge
 * in reverse, (0, 2 pi]: from the back of a portal to its front it is a full turn.
 */
static double dihedral(const struct mesh *mesh, const struct face *from, const struct face *to, unsigned corner)
{
	struct vec d = vec_unit(vec_sub(mesh->points[from->v[(corner + 1) % from->n]], mesh->points[from->v[corner]]));
	struct vec into_from = vec_cross(from->plane.n, d), into_to = vec_cross(d, to->plane.n);
	double angle = atan2(vec_dot(into_to, from->plane.n), vec_dot(into_to, into_from));

	return angle < 1e-6 ? angle + 6.28318530717958647692 : angle;
}

/* The next face across an edge, as seen from in front of this one; the number of faces: none. */
static unsigned neighbour(const struct mesh *mesh, const struct edge *edges, size_t n_edges, const struct edge *edge)
{
	uint64_t key = edge->key << 32 | edge->key >> 32;
	unsigned best = (unsigned)mesh->n_faces;
	double least = HUGE_VAL;

	for (const struct edge *e = first_edge(edges, n_edges, key); e < edges + n_edges && e->key == key; e++) {
		double angle = dihedral(mesh, &mesh->faces[edge->face], &mesh->faces[e->face], edge->corner);

		if (angle < least) {
			least = angle;
			best = e->face;
		}
	}
	return best;
}

/* --- Shells ------------------------------------------------------------------------------------------------------ */

struct shell {
	double volume; /* positive around empty space */
	struct box box;
	unsigned face; /* any of its faces */
	size_t n_faces;
	unsigned zone;
};

/* The representative of a face's set (union-find with path halving). */
static unsigned root_of(unsigned *parent, unsigned i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

/* Signed volume between a face and the origin, negative if it faces away from the origin. */
static double volume_under(const struct mesh *mesh, const struct face *face)
{
	struct winding w = mesh_winding(mesh, face);

	return -winding_area(&w) * face->plane.d / 3;
}

/* Number the sets, and find their bounds. parent becomes the number of each face's shell. */
static struct shell *list_shells(const struct mesh *mesh, unsigned *parent, size_t *n)
{
	unsigned *number = malloc((mesh->n_faces + 1) * sizeof(*number));
	struct shell *shells = NULL;

	if (!number)
		exit(1);
	*n = 0;
	for (unsigned f = 0; f < mesh->n_faces; f++)
		if (root_of(parent, f) == f) {
			number[f] = (unsigned)*n;
			ARRAY_PUSH(shells, *n, ((struct shell){ .box = box_empty(), .face = f }));
		}
	for (unsigned f = 0; f < mesh->n_faces; f++) {
		struct shell *shell = &shells[number[root_of(parent, f)]];

		shell->volume += volume_under(mesh, &mesh->faces[f]);
		shell->n_faces++;
		for (unsigned k = 0; k < mesh->faces[f].n; k++)
			box_add(&shell->box, mesh->points[mesh->faces[f].v[k]]);
	}
	for (unsigned f = 0; f < mesh->n_faces; f++)
		number[f] = number[root_of(parent, f)]; /* roots may come first or last in their sets */
	for (unsigned f = 0; f < mesh->n_faces; f++)
		parent[f] = number[f];
	free(number);
	return shells;
}

/* 1 if a ray meets a face: the hit lies on the inner side of all edges. */
static int meets_face(const struct mesh *mesh, const struct face *face, struct vec from, struct vec d, double *t)
{
	double slope = vec_dot(face->plane.n, d);
	struct vec hit;

	if (fabs(slope) < 1e-12)
		return 0;
	*t = -plane_distance(face->plane, from) / slope;
	if (*t <= 0)
		return 0;
	hit = vec_mad(from, d, *t);
	for (unsigned k = 0; k < face->n; k++) {
		struct vec a = mesh->points[face->v[k]], b = mesh->points[face->v[(k + 1) % face->n]];

		if (vec_dot(face->plane.n, vec_cross(vec_sub(b, a), vec_sub(hit, a))) < 0)
			return 0;
	}
	return 1;
}

/* No edge of a level lies in this direction. */
static const struct vec odd_direction = { 0.5773107, 0.3187411, 0.7517391 };

/* Parity of a ray's crossings of a shell; odd: the point is in it. */
static int is_in_shell(const struct mesh *mesh, const unsigned *shell_of, unsigned shell, struct vec p)
{
	int crossings = 0;
	double t;

	for (unsigned f = 0; f < mesh->n_faces; f++)
		crossings += shell_of[f] == shell && meets_face(mesh, &mesh->faces[f], p, odd_direction, &t);
	return crossings & 1;
}

/* The smallest shell around empty space that contains a solid's shell. */
static unsigned zone_around(const struct mesh *mesh, const unsigned *shell_of, const struct shell *shells, size_t n,
                            const struct shell *inner)
{
	struct winding w = mesh_winding(mesh, &mesh->faces[inner->face]);
	struct vec p = vec_mad(winding_centre(&w), mesh->faces[inner->face].plane.n, 1e-3);
	unsigned best = 0;
	double least = HUGE_VAL;

	for (unsigned i = 0; i < n; i++)
		if (shells[i].volume > 0 && shells[i].volume < least && box_meets(shells[i].box, inner->box, 0) &&
		    is_in_shell(mesh, shell_of, i, p)) {
			least = shells[i].volume;
			best = shells[i].zone;
		}
	return best;
}

/* --- Zones ------------------------------------------------------------------------------------------------------- */

static void collect_zones(struct mesh *mesh, struct zones *zones, const unsigned *shell_of, struct shell *shells,
                          size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (shells[i].volume > 0) {
			shells[i].zone = (unsigned)zones->n;
			ARRAY_PUSH(zones->items, zones->n, ((struct zone){ .box = shells[i].box }));
		}
	for (size_t i = 0; i < n; i++)
		if (shells[i].volume <= 0)
			shells[i].zone = zone_around(mesh, shell_of, shells, n, &shells[i]);
	for (size_t i = 0; i < n && zones->n; i++) {
		struct zone *zone = &zones->items[shells[i].zone];

		zone->volume += shells[i].volume;
		zone->n_faces += shells[i].n_faces;
		zone->n_shells++;
	}
	for (size_t f = 0; f < mesh->n_faces; f++)
		mesh->faces[f].zone = shells[shell_of[f]].zone;
}

void zones_find(struct mesh *mesh, struct zones *zones)
{
	size_t n_edges, n_shells;
	struct edge *edges = list_edges(mesh, &n_edges);
	unsigned *parent = malloc((mesh->n_faces + 1) * sizeof(*parent));
	struct shell *shells;

	if (!parent)
		exit(1);
	for (unsigned f = 0; f < mesh->n_faces; f++)
		parent[f] = f;
	for (size_t i = 0; i < n_edges; i++) {
		unsigned other = neighbour(mesh, edges, n_edges, &edges[i]);

		if (other == mesh->n_faces)
			zones->open_edges++;
		else
			parent[root_of(parent, edges[i].face)] = root_of(parent, other);
	}
	shells = list_shells(mesh, parent, &n_shells);
	collect_zones(mesh, zones, parent, shells, n_shells);
	free(shells);
	free(parent);
	free(edges);
}

size_t zones_at(const struct zones *zones, const struct mesh *mesh, struct vec p)
{
	size_t zone = zones->n;
	double nearest = HUGE_VAL, t;

	for (size_t f = 0; f < mesh->n_faces; f++)
		if (meets_face(mesh, &mesh->faces[f], p, odd_direction, &t) && t < nearest &&
		    plane_distance(mesh->faces[f].plane, p) > 0) {
			nearest = t;
			zone = mesh->faces[f].zone;
		}
	return zone;
}

void zones_free(struct zones *zones)
{
	free(zones->items);
	*zones = (struct zones){ .n = 0 };
}
