/* Builds a leaf BSP and answers queries. */
#include "bsp.h"

#include <math.h>
#include <stdlib.h>

#include "array.h"

/* A wall, or the part of it in the current space. */
struct piece {
	struct winding w;
	struct plane plane;
};

struct pieces {
	struct piece *items;
	size_t n;
};

/* --- Building ---------------------------------------------------------------------------------------------------- */

static int is_in_plane(const struct piece *piece, struct plane plane)
{
	for (int i = 0; i < piece->w.n; i++)
		if (fabs(plane_distance(plane, piece->w.p[i])) > 10 * ON_PLANE)
			return 0;
	return 1;
}

/* Prefer planes that cut few walls and balance both sides. */
static double cost_of(const struct pieces *pieces, struct plane plane)
{
	size_t front = 0, back = 0, cut = 0;

	for (size_t i = 0; i < pieces->n; i++) {
		int there[2] = { 0, 0 };

		for (int k = 0; k < pieces->items[i].w.n; k++) {
			double d = plane_distance(plane, pieces->items[i].w.p[k]);

			there[d < 0] |= fabs(d) > ON_PLANE;
		}
		cut += there[0] && there[1];
		front += there[0] && !there[1];
		back += there[1] && !there[0];
	}
	return 8.0 * (double)cut + fabs((double)front - (double)back);
}

static struct plane choose_plane(const struct pieces *pieces)
{
	struct plane best = pieces->items[0].plane;
	double least = HUGE_VAL;
	size_t step = pieces->n / 64 + 1; /* tries at most 64 planes */

	for (size_t i = 0; i < pieces->n; i += step) {
		double cost = cost_of(pieces, pieces->items[i].plane);

		if (cost < least) {
			least = cost;
			best = pieces->items[i].plane;
		}
	}
	return best;
}

static int add_leaf(struct bsp *bsp, int solid)
{
	ARRAY_PUSH(bsp->leaves, bsp->n_leaves, ((struct bsp_leaf){ .solid = solid, .box = box_empty() }));
	return ~(int)(bsp->n_leaves - 1);
}

/* Divide a space by the plane of one of its walls. A side without walls is all solid or all empty, depending on that
 * wall. */
static int build_node(struct bsp *bsp, struct pieces *pieces)
{
	struct pieces side[2] = { { .n = 0 }, { .n = 0 } };
	struct plane plane = choose_plane(pieces);
	int node = (int)bsp->n_nodes;

	ARRAY_PUSH(bsp->nodes, bsp->n_nodes, ((struct bsp_node){ .plane = plane }));
	for (size_t i = 0; i < pieces->n; i++) {
		struct piece part[2] = { pieces->items[i], pieces->items[i] };

		if (is_in_plane(&pieces->items[i], plane))
			continue;
		winding_split(&pieces->items[i].w, plane, &part[0].w, &part[1].w);
		for (int k = 0; k < 2; k++)
			if (part[k].w.n)
				ARRAY_PUSH(side[k].items, side[k].n, part[k]);
	}
	free(pieces->items);
	for (int k = 0; k < 2; k++) {
		int child = side[k].n ? build_node(bsp, &side[k]) : add_leaf(bsp, k);

		bsp->nodes[node].child[k] = child;
	}
	return node;
}

/* --- Walls of leaves --------------------------------------------------------------------------------------------- */

/* Pass a wall down to the leaves in front of it. */
static void list_face(struct bsp *bsp, int child, unsigned face, const struct piece *piece)
{
	if (child < 0) {
		struct bsp_leaf *leaf = &bsp->leaves[~child];

		if (!leaf->solid && (!leaf->n_faces || leaf->faces[leaf->n_faces - 1] != face))
			ARRAY_PUSH(leaf->faces, leaf->n_faces, face);
		for (int i = 0; i < piece->w.n; i++)
			box_add(&leaf->box, piece->w.p[i]);
	} else if (is_in_plane(piece, bsp->nodes[child].plane)) {
		list_face(bsp, bsp->nodes[child].child[vec_dot(piece->plane.n, bsp->nodes[child].plane.n) < 0], face, piece);
	} else {
		struct piece part[2] = { *piece, *piece };

		winding_split(&piece->w, bsp->nodes[child].plane, &part[0].w, &part[1].w);
		for (int k = 0; k < 2; k++)
			if (part[k].w.n)
				list_face(bsp, bsp->nodes[child].child[k], face, &part[k]);
	}
}

void bsp_build(struct bsp *bsp, const struct mesh *mesh)
{
	struct pieces pieces = { .n = 0 };

	for (size_t i = 0; i < mesh->n_faces; i++)
		if (mesh->faces[i].portal == NO_PORTAL)
			ARRAY_PUSH(pieces.items, pieces.n, ((struct piece){ mesh_winding(mesh, &mesh->faces[i]), mesh->faces[i].plane }));
	if (pieces.n)
		build_node(bsp, &pieces);
	else
		add_leaf(bsp, 1);
	for (unsigned i = 0; i < mesh->n_faces; i++) {
		struct piece piece = { mesh_winding(mesh, &mesh->faces[i]), mesh->faces[i].plane };

		if (mesh->faces[i].portal == NO_PORTAL)
			list_face(bsp, bsp->n_nodes ? 0 : ~0, i, &piece);
	}
}

/* --- Queries ----------------------------------------------------------------------------------------------------- */

unsigned bsp_find(const struct bsp *bsp, struct vec p)
{
	int child = bsp->n_nodes ? 0 : ~0;

	while (child >= 0)
		child = bsp->nodes[child].child[plane_distance(bsp->nodes[child].plane, p) < 0];
	return (unsigned)~child;
}

static int sees_below(const struct bsp *bsp, int child, struct vec from, struct vec to)
{
	while (child >= 0) {
		const struct bsp_node *node = &bsp->nodes[child];
		double a = plane_distance(node->plane, from), b = plane_distance(node->plane, to);
		struct vec cut;

		if ((a < 0) == (b < 0)) {
			child = node->child[a < 0];
			continue;
		}
		cut = vec_mad(from, vec_sub(to, from), a / (a - b));
		if (!sees_below(bsp, node->child[a < 0], from, cut))
			return 0;
		from = cut;
		child = node->child[b < 0];
	}
	return !bsp->leaves[~child].solid;
}

int bsp_sees(const struct bsp *bsp, struct vec from, struct vec to)
{
	return sees_below(bsp, bsp->n_nodes ? 0 : ~0, from, to);
}

/* Find the leaf below a child that contains the point, by asking each; -1: none. */
static int find_below(const struct bsp *bsp, int child, struct vec p, int holds)
{
	int front, back;

	if (child < 0)
		return holds ? ~child : -1;
	front = find_below(bsp, bsp->nodes[child].child[0], p, holds && plane_distance(bsp->nodes[child].plane, p) >= 0);
	back = find_below(bsp, bsp->nodes[child].child[1], p, holds && plane_distance(bsp->nodes[child].plane, p) < 0);
	return front > back ? front : back;
}

unsigned bsp_find_slowly(const struct bsp *bsp, struct vec p)
{
	return (unsigned)find_below(bsp, bsp->n_nodes ? 0 : ~0, p, 1);
}

void bsp_free(struct bsp *bsp)
{
	for (size_t i = 0; i < bsp->n_leaves; i++)
		free(bsp->leaves[i].faces);
	free(bsp->leaves);
	free(bsp->nodes);
	*bsp = (struct bsp){ .n_nodes = 0 };
}
