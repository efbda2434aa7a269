/*
 * Builders of bounding volume hierarchies over boxes, into flat node arrays (kernels/shared.h).
 *
 * The root is node 0. Its sides may be empty (BVH_EMPTY_LO > BVH_EMPTY_HI, count 0, child 0) where there are fewer than
 * two items; no other node has an empty side in node2. In node8 empty lanes may occur in every node, behind
 * those that are used.
 * No path from the root to a leaf is longer than BVH_MAX_DEPTH nodes (kernels/shared.h): the kernels' stacks rely on it.
 * Same boxes, same tree, whatever the number of threads.
 */
#ifndef TRACER_ACCEL_BVH_H
#define TRACER_ACCEL_BVH_H

#include "kernels/shared.h"

/* What a node's box tests cost, in triangle tests. */
#define BVH_COST_NODE 1.0f

struct bvh_box {
	float lo[3], hi[3];
};

/** An empty box, and its growth to hold another. */
void bvh_box_clear(struct bvh_box *box);
void bvh_box_join(struct bvh_box *box, const struct bvh_box *other);

/**
 * Build a binary tree with the binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding
 * volume hierarchies").
 *
 * @param boxes     [n], finite, lo <= hi
 * @param leaf_max  most items in a leaf, >= 1
 * @param threads   at most so many; 0: as many as there are processors
 * @param nodes     receives at most max(n, 1) nodes
 * @param n_nodes   how many they are, at least 1
 * @param order     [n], receives the items in leaf order: a leaf's first and count are places in it
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_build_sah(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                  uint32_t *n_nodes, uint32_t *order);

/**
 * The same with spatial splits (Stich, Friedrich and Dietrich 2009, "Spatial splits in bounding volume hierarchies"): a triangle
 * may be in several leaves, each time with the box of a piece of it.
 *
 * @param triangles  [n], in the boxes; the boxes may be larger by what counts as a hit (kernels/rays/rays.h)
 * @param room       most items that the leaves may hold in all; at least n
 * @param nodes      [room]
 * @param order      [room], receives the items in leaf order
 * @param n_order    how many they are
 */
int bvh_build_sbvh(const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, unsigned threads,
                   uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order);

/**
 * A kd-tree by the surface area heuristic (kd_split.h), as a binary tree whose sides bound what their cells hold: cells never
 * overlap, so that a triangle is in the leaf of every cell that it crosses, each time with the box of its piece there. Where no
 * plane pays and more than leaf_max are left, and where room or depth ends, items are divided as bvh_build_sah does.
 *
 * The parameters are those of bvh_build_sbvh; room for three to five times the triangles is seldom used up.
 */
int bvh_build_kd(const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, unsigned threads,
                 uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order);

/* How the builders by surface area divide a part: its items; them, or space where these would overlap; space first of all. */
enum bvh_splits { BVH_OBJECTS, BVH_SPATIAL, BVH_PLANES };

/**
 * The quickest (Lauterbach, Garland, Sengupta, Luebke and Manocha 2009, "Fast BVH construction on GPUs"): items in the order of
 * their centres on a Morton curve, divided where the curve's cells are; a subtree is one leaf where that is cheaper.
 * The parameters are those of bvh_build_sah.
 */
int bvh_build_linear(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                     uint32_t *n_nodes, uint32_t *order);

/**
 * What a ray that meets the root is expected to pay (MacDonald and Booth 1990, "Heuristics for ray tracing using space
 * subdivision"): the sum over nodes of their area over the root's, times BVH_COST_NODE for an inner node and 1 for each item of a leaf.
 */
double bvh_cost(const struct node2 *nodes, uint32_t n_nodes);

/**
 * Fit the boxes of a tree to items that have moved; what is below what stays. After spatial splits, items in several leaves count
 * whole in each.
 *
 * @param nodes  children behind their parents, as all builders give them
 * @param boxes  of the items that `order` names
 */
void bvh_refit(struct node2 *nodes, uint32_t n_nodes, const struct bvh_box *boxes, const uint32_t *order);

/* What the leaves of an eight-wide tree count: items as they are, or blocks of up to eight of them. */
enum bvh_leaves { BVH_ITEMS, BVH_BLOCKS };

/**
 * Collapse a binary tree into one with eight children a node: the largest inner child is opened until there are eight.
 * With BVH_BLOCKS every subtree of at most eight items becomes one block: child is the block's number and count is 1.
 *
 * @param nodes2    as built above
 * @param nodes     receives at most n_nodes2 nodes
 * @param block_first, block_count  per block its first item and their number in leaf order; room for n items;
 *                  NULL with BVH_ITEMS
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_collapse8(const struct node2 *nodes2, uint32_t n_nodes2, enum bvh_leaves leaves, struct node8 *nodes,
                  uint32_t *n_nodes, uint32_t *block_first, uint32_t *block_count, uint32_t *n_blocks);

/**
 * The same with all items as they are, into nodes of 80 bytes (kernels/shared.h: struct node8c): those that cost least by the
 * measure of bvh_cost. A leaf of more than NODE8C_LEAF_MAX items becomes nodes.
 *
 * @param nodes2     as built above, of leaves of at most BVH_COMPRESSED_LEAF items
 * @param triangles  [n_items], in leaf order
 * @param nodes      receives at most BVH_COMPRESSED_NODES(n_nodes2, n_items) nodes; children come after their parents
 * @param out        [n_items], receives the triangles in the new nodes' order
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_compress8(const struct node2 *nodes2, uint32_t n_nodes2, const struct triangle *triangles, uint32_t n_items,
                  struct node8c *nodes, uint32_t *n_nodes, struct triangle *out);
#define BVH_COMPRESSED_NODES(n_nodes2, n_items) ((size_t)(n_nodes2) + (n_items) / NODE8C_LEAF_MAX)
#define BVH_COMPRESSED_LEAF (NODE8C_LEAF_MAX << 3 * (NODE8C_MAX_DEPTH - BVH_MAX_DEPTH))

#endif
