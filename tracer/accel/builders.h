/*
 * The tree builders: one row each. From this list come enum accel_kind, the prototypes, what command lines and their
 * help know, and what `relume bench --accel all` measures. A new builder is its own .c, a row at the end, and a test
 * (tests/unit/test_blas_store.c keeps a checksum of each builder's tree).
 *
 * Same input, same tree, whatever the number of threads.
 *
 *   BVH   The binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume
 *         hierarchies").
 *   SBVH  The same with spatial splits (Stich, Friedrich and Dietrich 2009, "Spatial splits in bounding volume
 *         hierarchies"): a triangle may be in several leaves, each time with the box of a piece of it.
 *   KD    A kd-tree by the surface area heuristic (kd_split.h), as a binary tree whose sides bound what their cells
 *         hold. Cells never overlap: a triangle is in the leaf of every cell that it crosses, each time with the box of
 *         its piece there. Where no plane pays and a leaf would be too large, and where room or depth ends, it divides
 *         items as BVH does.
 *   LBVH  The quickest (Lauterbach, Garland, Sengupta, Luebke and Manocha 2009, "Fast BVH construction on GPUs"): items
 *         in the order of their centres on a Morton curve, divided where the curve's cells are; a subtree is one leaf
 *         where that is cheaper.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/soup.h"
#include "tracer/accel/tree.h"

/*
 * ROW(kind, name, build, spare, keep_from, help)
 *   kind       ACCEL_kind; its number is part of the name of trees on disk: new rows go to the end
 *   name       what command lines call it
 *   build      its function
 *   spare      most items that cutting triangles may add, for each triangle; 0: it cuts none
 *   keep_from  triangles from which on a tree is kept on disk: below, building it takes no longer than reading a file
 *   help       what it is, for help texts
 */
#define TREE_BUILDERS(ROW) \
	ROW(BVH, "bvh", bvh_build_sah, 0, 16384, "binned") \
	ROW(SBVH, "sbvh", bvh_build_sbvh, 0.25, 1024, "with spatial splits: some percent cheaper to trace, " \
	"ten times the time to build") \
	ROW(KD, "kd", bvh_build_kd, 3, 1024, "a kd-tree") \
	ROW(LBVH, "lbvh", bvh_build_linear, 0, 65536, "along a Morton curve: the quickest to build")

/* How the trees of meshes are built. Meshes that live for one frame get binned ones, whatever is asked for. */
#define TREE_BUILDER_KIND(kind, ...) ACCEL_##kind,
enum accel_kind { TREE_BUILDERS(TREE_BUILDER_KIND) N_ACCEL_KINDS };

/* What a builder builds from. */
struct bvh_input {
	const struct bvh_box *boxes;      /* [n], finite, lo <= hi */
	const struct triangle *triangles; /* [n], in the boxes, which may be larger by what counts as a hit
	                                   * (kernels/rays/rays.h); NULL for builders that cut none */
	uint32_t n;
	uint32_t leaf_max; /* most items in a leaf, >= 1 */
	uint32_t room;     /* most items in all leaves, >= n, for builders that cut */
	unsigned threads;  /* at most so many; 0: as many as there are processors */
};

/**
 * Build a tree.
 * @param out  nodes and order have room for max(room, 1) items each, max(n, 1) for builders that cut none. Filled in:
 *             both, n_nodes (at least 1) and n_order
 * @return 0 or ERR_SYSTEM (reported)
 */
typedef int tree_builder(const struct bvh_input *in, struct tree *out);
#define TREE_BUILDER_DECLARE(kind, name, build, ...) tree_builder build;
TREE_BUILDERS(TREE_BUILDER_DECLARE)

/** Names by kind; NULL ends them. */
extern const char *const accel_kind_names[N_ACCEL_KINDS + 1];

/** Raise it whenever a builder gives another tree for the same triangles: kept trees of other versions are not used. */
#define TREE_VERSION 1u

/**
 * Find a tree in the store, or build it.
 *
 * @param soup   triangles; boxes that are not those of triangles (soup.bounded) are never cut
 * @param hash   of all that the soup was made from
 * @param store  looked into, and written to, where building takes longer than reading; NULL: there is none
 * @param out    receives the tree; free with tree_free, also after an error
 * @return 0 or ERR_SYSTEM (reported). That a tree cannot be kept is no error
 */
int builders_make_tree(const struct soup *soup, enum accel_kind kind, const uint64_t hash[2], struct blas_store *store,
                       struct tree *out);
