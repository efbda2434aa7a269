/*
 * The binary tree over a mesh's triangles: by one of several builders, or from the folder where an earlier run left it.
 * All builders make the same kind of nodes, so that every kernel walks every tree; no hit depends on the tree that found it
 * (kernels/rays/rays.h).
 */
#ifndef TRACER_ACCEL_TREE_H
#define TRACER_ACCEL_TREE_H

#include "kernels/shared.h"
#include "tracer/accel/soup.h"
#include "tracer/accel/blas_store.h"

/* How the trees of meshes are built. What lives for one frame only gets binned ones whatever is asked for. */
enum accel_kind {
	ACCEL_BVH,  /* binned SAH */
	ACCEL_SBVH, /* the same with spatial splits: a triangle may be in several leaves */
	ACCEL_KD,   /* kd-tree: cells that do not overlap, a triangle in each that it crosses */
	ACCEL_LBVH, /* along a Morton curve: the quickest to build */
	N_ACCEL_KINDS
};

/** What the kinds are called on command lines; NULL ends it. */
extern const char *const tree_kind_names[N_ACCEL_KINDS + 1];

/** To be raised whenever a builder gives another tree for the same triangles: kept trees of other versions are not used. */
#define TREE_VERSION 1u

/* As bvh.h describes nodes and order. */
struct tree {
	struct node2 *nodes;
	uint32_t *order;
	uint32_t n_nodes, n_order; /* n_order: more than there are triangles where some are in several leaves */
};

/**
 * Build a tree, or find it.
 *
 * @param soup   triangles; boxes that are not those of triangles (soup.bounded) are never cut
 * @param hash   of all that the soup was made from
 * @param store  where it may lie, and is left if building it takes longer than reading it; NULL: nowhere
 * @param out    receives the tree, to be freed with tree_free, also after an error
 * @return 0 or ERR_SYSTEM (reported). That a tree cannot be kept is no error
 */
int tree_make(const struct soup *soup, enum accel_kind kind, const uint64_t hash[2], struct blas_store *store, struct tree *out);

/**
 * Fit a tree to the same triangles, some of which have moved.
 *
 * @param old   of as many triangles as there are now
 * @param most  SAH cost (bvh_cost) up to which the tree is worth keeping
 * @param out   receives the tree, to be freed with tree_free, also after an error; empty where it costs more
 * @return 0 or ERR_SYSTEM (reported)
 */
int tree_refit(const struct tree *old, const struct soup *soup, double most, struct tree *out);
void tree_free(struct tree *tree);

/**
 * Can the kernels walk it, and wide nodes be made of it? Every index in range, each node below one other and behind it, leaves no larger
 * than they are built, no path longer than BVH_MAX_DEPTH.
 */
int tree_is_sound(const struct tree *tree, uint32_t n_triangles);

#endif
