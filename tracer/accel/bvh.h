/*
 * Bounding volume hierarchies in flat node arrays (kernels/shared.h): what a tree is, what it costs, and its eight-wide
 * form. builders.h lists who builds them.
 *
 * The root is node 0. It may have empty sides (BVH_EMPTY_LO > BVH_EMPTY_HI, count 0, child 0) where there are fewer
 * than two items; no other node2 has one. Any node8 may have empty lanes, behind those in use. No path from the root to
 * a leaf is longer than BVH_MAX_DEPTH nodes (kernels/shared.h): the kernels' stacks rely on it.
 */
#pragma once

#include "kernels/shared.h"

/* What a node's box tests cost, in triangle tests. */
#define BVH_COST_NODE 1.0f

struct bvh_box {
	float lo[3], hi[3];
};

/** Empty a box; grow it to hold another. */
void bvh_box_clear(struct bvh_box *box);
void bvh_box_join(struct bvh_box *box, const struct bvh_box *other);

/**
 * What a ray that meets the root is expected to pay (MacDonald and Booth 1990, "Heuristics for ray tracing using space
 * subdivision"): the sum over nodes of their area over the root's, times BVH_COST_NODE for an inner node and 1 for each
 * item of a leaf.
 */
double bvh_cost(const struct node2 *nodes, uint32_t n_nodes);

/**
 * Fit the boxes of a tree to items that have moved; its structure stays. After spatial splits an item in several leaves
 * counts whole in each.
 *
 * @param nodes  children behind their parents, as all builders give them
 * @param boxes  of the items that `order` names
 */
void bvh_refit(struct node2 *nodes, uint32_t n_nodes, const struct bvh_box *boxes, const uint32_t *order);

/* What the leaves of an eight-wide tree count: items as they are, or blocks of up to eight of them. */
enum bvh_leaves { BVH_ITEMS, BVH_BLOCKS };

/**
 * Collapse a binary tree into one with eight children a node: open the largest inner child until there are eight.
 * With BVH_BLOCKS every subtree of at most eight items becomes one block: child is the block's number and count is 1.
 *
 * @param nodes2    a binary tree
 * @param nodes     receives at most n_nodes2 nodes
 * @param block_first, block_count  per block its first item and their number in leaf order; room for n items;
 *                  NULL with BVH_ITEMS
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_collapse8(const struct node2 *nodes2, uint32_t n_nodes2, enum bvh_leaves leaves, struct node8 *nodes,
                  uint32_t *n_nodes, uint32_t *block_first, uint32_t *block_count, uint32_t *n_blocks);
