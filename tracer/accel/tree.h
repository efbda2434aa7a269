/*
 * The binary tree over a mesh's triangles. All builders make the same kind of nodes, so every kernel can traverse every
 * tree. The hits found do not depend on the tree (kernels/rays/rays.h).
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/soup.h"

/** Most triangles in a leaf. */
#define TREE_LEAF_TRIANGLES 4

/* Nodes as bvh.h describes them. */
struct tree {
	struct node2 *nodes;
	uint32_t *order; /* items in leaf order; a leaf's first and count index it */
	uint32_t n_nodes, n_order; /* n_order exceeds the number of items if some are in several leaves */
};

/**
 * Refit a tree to triangles that have moved.
 *
 * @param old   tree over the same number of triangles
 * @param most  highest SAH cost (bvh_cost) of a tree worth keeping
 * @param out   receives the tree; free with tree_free, also after an error; empty if it would cost more
 * @return 0 or ERR_SYSTEM (reported)
 */
int tree_refit(const struct tree *old, const struct soup *soup, double most, struct tree *out);
void tree_free(struct tree *tree);

/**
 * Can kernels traverse the tree, and can wide nodes be made from it? True if every index is in range, boxes are finite
 * and none is inverted, each node but the root has one parent and comes after it, leaves have at most
 * TREE_LEAF_TRIANGLES, and no path is longer than BVH_MAX_DEPTH.
 */
int tree_is_sound(const struct tree *tree, uint32_t n_triangles);
