/* An octree over the walls; every leaf lists, uncut, each wall whose box reaches into it. */
#pragma once

#include "mesh.h"

struct octree_node {
	struct box box;
	unsigned first_child; /* first of eight; 0: a leaf */
	unsigned *faces;      /* owned; leaves only */
	size_t n_faces;
};

struct octree {
	struct octree_node *nodes; /* the first is the root */
	size_t n_nodes;
};

void octree_build(struct octree *tree, const struct mesh *mesh);
void octree_free(struct octree *tree);
