/*
 * Compression of binary trees to eight-wide nodes of 80 bytes (kernels/shared.h: struct node8c), for GPUs.
 */
#pragma once

#include "kernels/shared.h"

/* Most nodes that a tree may need, and most items in a leaf of the binary tree. */
#define BVH_COMPRESSED_NODES(n_nodes2, n_items) ((size_t)(n_nodes2) + (n_items) / NODE8C_LEAF_MAX)
#define BVH_COMPRESSED_LEAF (NODE8C_LEAF_MAX << 3 * (NODE8C_MAX_DEPTH - BVH_MAX_DEPTH))

/**
 * Collapse a binary tree into the compressed nodes with the lowest bvh_cost. A leaf with more than NODE8C_LEAF_MAX
 * items is split into nodes.
 *
 * @param nodes2     as bvh.h describes them, with leaves of at most BVH_COMPRESSED_LEAF items
 * @param triangles  [n_items], in leaf order
 * @param nodes      receives at most BVH_COMPRESSED_NODES(n_nodes2, n_items) nodes; children come after their parents
 * @param out        [n_items], receives the triangles in the new nodes' order
 * @return 0 or ERR_SYSTEM (reported)
 */
int bvh_compress8(const struct node2 *nodes2, uint32_t n_nodes2, const struct triangle *triangles, uint32_t n_items,
                  struct node8c *nodes, uint32_t *n_nodes, struct triangle *out);
