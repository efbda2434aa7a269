/*
 * The binary tree over a mesh's triangles. All builders make the same kind of nodes, so that every kernel walks every
 * tree; no hit depends on the tree that found it (kernels/rays/rays.h).
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/soup.h"

/** Most triangles in a leaf. */
#define TREE_LEAF_TRIANGLES 4

/* Nodes as bvh.h describes them. */
struct tree {
	struct node2 *nodes;
	uint32_t *order; /* items in leaf order: a leaf's first and count are places in it */
	uint32_t n_nodes, n_order; /* n_order: more than there are items where some are in several leaves */
};

/**
 * Fit a tree to the same triangles, some of which have moved.
 *
 * @param old   of as many triangles as there are now
 * @param most  SAH cost (bvh_cost) up to which the tree is worth keeping
 * @param out   receives the tree; free with tree_free, also after an error; empty where it would cost more
 * @return 0 or ERR_SYSTEM (reported)
 */
int tree_refit(const struct tree *old, const struct soup *soup, double most, struct tree *out);
void tree_free(struct tree *tree);

/**
 * Can the kernels walk it, and wide nodes be made of it? Every index is in range, boxes are finite and none is inside
 * out, each node is below one other and behind it, leaves hold at most TREE_LEAF_TRIANGLES, and no path is longer than
 * BVH_MAX_DEPTH.
 */
int tree_is_sound(const struct tree *tree, uint32_t n_triangles);
