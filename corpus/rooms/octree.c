/* Builds an octree over the walls. */
#include "octree.h"

#include <stdlib.h>

#include "array.h"

/* A node is divided unless it is MAX_DEPTH levels below the root or lists at most FEW_FACES faces. */
enum { MAX_DEPTH = 5, FEW_FACES = 12 };

static struct box octant(struct box box, int which)
{
	struct vec middle = vec_scale(vec_add(box.min, box.max), 0.5);

	return (struct box){ vec(which & 1 ? middle.x : box.min.x, which & 2 ? middle.y : box.min.y,
		                 which & 4 ? middle.z : box.min.z),
		             vec(which & 1 ? box.max.x : middle.x, which & 2 ? box.max.y : middle.y,
		                 which & 4 ? box.max.z : middle.z) };
}

static void divide(struct octree *tree, const struct mesh *mesh, unsigned node, int depth)
{
	unsigned first = (unsigned)tree->n_nodes;

	if (depth == MAX_DEPTH || tree->nodes[node].n_faces <= FEW_FACES)
		return;
	for (int i = 0; i < 8; i++) {
		struct octree_node child = { .box = octant(tree->nodes[node].box, i) };

		for (size_t k = 0; k < tree->nodes[node].n_faces; k++) {
			struct winding w = mesh_winding(mesh, &mesh->faces[tree->nodes[node].faces[k]]);

			if (box_meets(winding_box(&w), child.box, 0))
				ARRAY_PUSH(child.faces, child.n_faces, tree->nodes[node].faces[k]);
		}
		ARRAY_PUSH(tree->nodes, tree->n_nodes, child);
	}
	free(tree->nodes[node].faces);
	tree->nodes[node].faces = NULL;
	tree->nodes[node].n_faces = 0;
	tree->nodes[node].first_child = first;
	for (unsigned i = 0; i < 8; i++)
		divide(tree, mesh, first + i, depth + 1);
}

void octree_build(struct octree *tree, const struct mesh *mesh)
{
	struct octree_node root = { .box = box_empty() };

	for (unsigned i = 0; i < mesh->n_faces; i++) {
		if (mesh->faces[i].portal != NO_PORTAL)
			continue;
		ARRAY_PUSH(root.faces, root.n_faces, i);
		for (unsigned k = 0; k < mesh->faces[i].n; k++)
			box_add(&root.box, mesh->points[mesh->faces[i].v[k]]);
	}
	ARRAY_PUSH(tree->nodes, tree->n_nodes, root);
	divide(tree, mesh, 0, 0);
}

void octree_free(struct octree *tree)
{
	for (size_t i = 0; i < tree->n_nodes; i++)
		free(tree->nodes[i].faces);
	free(tree->nodes);
	*tree = (struct octree){ .n_nodes = 0 };
}
