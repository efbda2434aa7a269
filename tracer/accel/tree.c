#include "tracer/accel/tree.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

const char *const tree_kind_names[N_ACCEL_KINDS + 1] = { [ACCEL_BVH] = "bvh", [ACCEL_SBVH] = "sbvh", [ACCEL_KD] = "kd",
	                                                 [ACCEL_LBVH] = "lbvh" };

/* Most triangles in a leaf. */
#define LEAF_TRIANGLES 4
/* How many more items than triangles cutting space may make, for each triangle. */
#define SPATIAL_SHARE 0.25
#define KD_SHARE 3.0

/* From how many triangles on a tree is kept: below, building it takes no longer than reading a file from a disk. */
static const uint32_t keep_from[N_ACCEL_KINDS] = { [ACCEL_BVH] = 16384, [ACCEL_SBVH] = 1024, [ACCEL_KD] = 1024,
	                                               [ACCEL_LBVH] = 65536 };

static int build(const struct soup *soup, enum accel_kind kind, struct tree *tree)
{
	const double more = !soup->bounded ? 0 : kind == ACCEL_SBVH ? SPATIAL_SHARE : kind == ACCEL_KD ? KD_SHARE : 0;
	const uint32_t n = soup->n, room = n + 1 + (uint32_t)(more * n);

	if (room < n)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: a mesh of %u triangles is too large", n);
	tree->nodes = malloc(room * sizeof(*tree->nodes));
	tree->order = malloc(room * sizeof(*tree->order));
	if (!tree->nodes || !tree->order)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	tree->n_order = n;
	if (more > 0)
		return (kind == ACCEL_KD ? bvh_build_kd : bvh_build_sbvh)(soup->boxes, soup->triangles, n, LEAF_TRIANGLES, 0, room, tree->nodes,
		                                                          &tree->n_nodes, tree->order, &tree->n_order);
	return (kind == ACCEL_LBVH ? bvh_build_linear : bvh_build_sah)(soup->boxes, n, LEAF_TRIANGLES, 0, tree->nodes, &tree->n_nodes,
	                                                               tree->order);
}

int tree_make(const struct soup *soup, enum accel_kind kind, const uint64_t hash[2], struct blas_store *store, struct tree *out)
{
	const struct blas_store_key key = { { hash[0], hash[1] }, TREE_VERSION, kind, soup->n };
	const int keep = store && soup->n >= keep_from[kind];
	int err;

	*out = (struct tree){ NULL };
	if (keep && blas_store_load(store, &key, out))
		return 0;
	err = build(soup, kind, out);
	if (!err && keep)
		blas_store_save(store, &key, out);
	return err;
}

int tree_refit(const struct tree *old, const struct soup *soup, double most, struct tree *out)
{
	*out = (struct tree){ malloc(old->n_nodes * sizeof(*out->nodes)), malloc(old->n_order * sizeof(*out->order) + 1), old->n_nodes,
		              old->n_order };
	if (!out->nodes || !out->order)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	memcpy(out->nodes, old->nodes, old->n_nodes * sizeof(*out->nodes));
	memcpy(out->order, old->order, old->n_order * sizeof(*out->order));
	bvh_refit(out->nodes, out->n_nodes, soup->boxes, out->order);
	if (!(bvh_cost(out->nodes, out->n_nodes) <= most))
		tree_free(out);
	return 0;
}

void tree_free(struct tree *tree)
{
	free(tree->nodes);
	free(tree->order);
	*tree = (struct tree){ NULL };
}

/* One side of a node; notes how deep its child is (0: nobody has come to it yet) and how many items leaves hold. */
static int side_is_sound(const struct tree *tree, uint32_t at, int side, uint8_t *depth, uint64_t *items)
{
	const uint32_t child = tree->nodes[at].child[side], count = tree->nodes[at].count[side];

	*items += count;
	if (count)
		return count <= LEAF_TRIANGLES && child <= tree->n_order && count <= tree->n_order - child;
	if (!child)
		return at == 0 && tree->nodes[at].lo[side][0] > tree->nodes[at].hi[side][0]; /* an empty side */
	if (child <= at || child >= tree->n_nodes || depth[child] || depth[at] + 1 >= BVH_MAX_DEPTH)
		return 0;
	depth[child] = (uint8_t)(depth[at] + 1);
	return 1;
}

int tree_is_sound(const struct tree *tree, uint32_t n_triangles)
{
	uint8_t *depth = calloc(tree->n_nodes + 1, sizeof(*depth));
	int sound = depth && tree->n_nodes > 0;
	uint64_t items = 0;

	for (uint32_t i = 0; i < tree->n_nodes && sound; i++)
		sound = (i == 0 || depth[i]) && side_is_sound(tree, i, 0, depth, &items) && side_is_sound(tree, i, 1, depth, &items);
	for (uint32_t i = 0; i < tree->n_order && sound; i++)
		sound = tree->order[i] < n_triangles;
	free(depth);
	return sound && items == tree->n_order;
}
