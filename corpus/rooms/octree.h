/* An octree over the walls: a wall stands in every leaf that its box reaches into, whole. */
#pragma once

#include "mesh.h"

struct octree_node {
	struct box box;
	unsigned first_child; /* of eight; 0: a leaf */
	unsigned *faces;      /* owned, of a leaf */
	size_t n_faces;
};

struct octree {
	struct octree_node *nodes; /* the first is the root */
	size_t n_nodes;
};

void octree_build(struct octree *tree, const struct mesh *mesh);
void octree_free(struct octree *tree);
