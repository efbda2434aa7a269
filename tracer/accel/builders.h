/*
 * The tree builders, one row each. This list generates enum accel_kind, the prototypes, the names and help on command
 * lines, and the rows of `relume bench --accel all`. To add a builder, write its .c file, a row at the end, and a test
 * (tests/unit/test_blas_store.c has a checksum of each builder's tree).
 *
 * The same input gives the same tree with any number of threads.
 *
 *   BVH   The binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume
 *         hierarchies").
 *   SBVH  The same with spatial splits (Stich, Friedrich and Dietrich 2009, "Spatial splits in bounding volume
 *         hierarchies"): a triangle may be in several leaves, in each with the bounds of one piece.
 *   KD    A kd-tree by the surface area heuristic (kd_split.h), stored as a binary tree whose boxes bound the contents
 *         of the cells. Cells never overlap: a triangle is in the leaf of every cell it crosses, in each with the
 *         bounds of its piece there. If no plane pays but the leaf would be too large, or if room or depth runs out,
 *         items are divided as for BVH.
 *   LBVH  The fastest to build (Lauterbach, Garland, Sengupta, Luebke and Manocha 2009, "Fast BVH construction on
 *         GPUs"): items are sorted along a Morton curve by their centres and divided at the curve's cell boundaries. A
 *         subtree becomes one leaf if that is cheaper.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/soup.h"
#include "tracer/accel/tree.h"

/*
 * ROW(kind, name, build, spare, keep_from, help)
 *   kind       ACCEL_kind; its number is part of the file name of stored trees, so new rows go at the end
 *   name       its name on command lines
 *   build      its function
 *   spare      most items that cutting may add per triangle; 0: the builder cuts none
 *   keep_from  fewest triangles of a tree worth storing on disk; smaller trees are built as fast as they are read
 *   help       its description in help texts
 */
#define TREE_BUILDERS(ROW) \
	ROW(BVH, "bvh", bvh_build_sah, 0, 16384, "binned") \
	ROW(SBVH, "sbvh", bvh_build_sbvh, 0.25, 1024, "with spatial splits: some percent cheaper to trace, " \
	"ten times the time to build") \
	ROW(KD, "kd", bvh_build_kd, 3, 1024, "a kd-tree") \
	ROW(LBVH, "lbvh", bvh_build_linear, 0, 65536, "along a Morton curve: the quickest to build")

/* The builder of mesh trees. Meshes that live for one frame get binned trees, whatever the setting. */
#define TREE_BUILDER_KIND(kind, ...) ACCEL_##kind,
enum accel_kind { TREE_BUILDERS(TREE_BUILDER_KIND) N_ACCEL_KINDS };

/* Input of a builder. */
struct bvh_input {
	const struct bvh_box *boxes;      /* [n], finite, lo <= hi */
	const struct triangle *triangles; /* [n]; the boxes contain them, widened by the hit tolerance
	                                   * (kernels/rays/rays.h); NULL for builders that cut none */
	uint32_t n;
	uint32_t leaf_max; /* most items in a leaf, >= 1 */
	uint32_t room;     /* most items in all leaves, >= n, for builders that cut */
	unsigned threads;  /* most threads to use; 0: one per processor */
};

/**
 * Build a tree.
 * @param out  receives nodes, order, n_nodes (at least 1) and n_order. The caller allocates nodes and order with room
 *             for max(room, 1) items each; max(n, 1) for builders that cut none
 * @return 0 or ERR_SYSTEM (reported)
 */
typedef int tree_builder(const struct bvh_input *in, struct tree *out);
#define TREE_BUILDER_DECLARE(kind, name, build, ...) tree_builder build;
TREE_BUILDERS(TREE_BUILDER_DECLARE)

/** Names indexed by kind, followed by NULL. */
extern const char *const accel_kind_names[N_ACCEL_KINDS + 1];

/** Raise whenever a builder's tree for the same triangles changes. Stored trees of other versions are ignored. */
#define TREE_VERSION 1u

/**
 * Find a tree in the store, or build it.
 *
 * @param soup   triangles to build from; cut only if all boxes are bounds of triangles (soup.bounded)
 * @param hash   hash of everything that the soup was made from
 * @param store  read and written if building takes longer than reading; NULL: no store
 * @param out    receives the tree; free with tree_free, also after an error
 * @return 0 or ERR_SYSTEM (reported). Failing to store a tree is no error
 */
int builders_make_tree(const struct soup *soup, enum accel_kind kind, const uint64_t hash[2], struct blas_store *store,
                       struct tree *out);
