/*
 * Bounding volume hierarchies in flat node arrays (kernels/shared.h): their invariants, their cost, and their
 * eight-wide form. builders.h lists the builders.
 *
 * The root is node 0. It may have empty sides (BVH_EMPTY_LO > BVH_EMPTY_HI, count 0, child 0) if there are fewer than
 * two items; no other node2 has one. Any node8 may have empty lanes, after those in use. No path from the root to a
 * leaf is longer than BVH_MAX_DEPTH nodes (kernels/shared.h): the kernels' stacks rely on it.
 */
#pragma once

#include "kernels/shared.h"

/* Cost of a node's box tests, in triangle tests. */
#define BVH_COST_NODE 1.0f

struct bvh_box {
	float lo[3], hi[3];
};

/** Make a box empty; grow it to contain another. */
void bvh_box_clear(struct bvh_box *box);
void bvh_box_join(struct bvh_box *box, const struct bvh_box *other);

/**
 * Expected cost of a ray that hits the root's box (MacDonald and Booth 1990, "Heuristics for ray tracing using space
 * subdivision"): the sum over all nodes of the node's area divided by the root's, times BVH_COST_NODE for an inner
 * node, or 1 per item for a leaf.
 */
double bvh_cost(const struct node2 *nodes, uint32_t n_nodes);

/**
 * Refit the boxes of a tree to moved items. Its structure is unchanged. An item that spatial splits put in several
 * leaves is bounded whole in each.
 *
 * @param nodes  children after their parents, as all builders order them
 * @param boxes  boxes of the items in `order`
 */
void bvh_refit(struct node2 *nodes, uint32_t n_nodes, const struct bvh_box *boxes, const uint32_t *order);

/* Contents of the leaves of an eight-wide tree: single items, or blocks of up to eight. */
enum bvh_leaves { BVH_ITEMS, BVH_BLOCKS };

/**
 * Collapse a binary tree into one with eight children per node: open the largest inner child until there are eight.
 * With BVH_BLOCKS every subtree of at most eight items becomes one block, whose leaf has the block's number as child
 * and a count of 1.
 *
 * @param nodes2    a binary tree
 * @param nodes     receives at most n_nodes2 nodes
 * @param block_first, block_count  receive the first item of each block, in leaf order, and the number of items; room
 *                                  for n items; NULL with BVH_ITEMS
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_collapse8(const struct node2 *nodes2, uint32_t n_nodes2, enum bvh_leaves leaves, struct node8 *nodes,
                  uint32_t *n_nodes, uint32_t *block_first, uint32_t *block_count, uint32_t *n_blocks);
