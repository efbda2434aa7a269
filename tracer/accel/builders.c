#include "tracer/accel/builders.h"

#include <stdlib.h>

#include "base/err.h"

#define NAME(kind, name, ...) [ACCEL_##kind] = name,
const char *const accel_kind_names[N_ACCEL_KINDS + 1] = { TREE_BUILDERS(NAME) };

#define ROW(kind, name, build, spare, keep_from, help) [ACCEL_##kind] = { build, spare, keep_from },
static const struct {
	tree_builder *build;
	double spare;
	uint32_t keep_from;
} builders[N_ACCEL_KINDS] = { TREE_BUILDERS(ROW) };

static int build(const struct soup *soup, enum accel_kind kind, struct tree *tree)
{
	const enum accel_kind by = builders[kind].spare > 0 && !soup->bounded ? ACCEL_BVH : kind;
	const uint32_t n = soup->n, room = n + 1 + (uint32_t)(builders[by].spare * n);
	const struct bvh_input in = { soup->boxes, soup->triangles, n, TREE_LEAF_TRIANGLES, room, 0 };

	if (room < n)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: a mesh of %u triangles is too large", n);
	tree->nodes = malloc(room * sizeof(*tree->nodes));
	tree->order = malloc(room * sizeof(*tree->order));
	if (!tree->nodes || !tree->order)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	return builders[by].build(&in, tree);
}

int builders_make_tree(const struct soup *soup, enum accel_kind kind, const uint64_t hash[2], struct blas_store *store,
                       struct tree *out)
{
	const struct blas_store_key key = { { hash[0], hash[1] }, TREE_VERSION, kind, soup->n };
	const int keep = store && soup->n >= builders[kind].keep_from;
	int err;

	*out = (struct tree){ NULL };
	if (keep && blas_store_load(store, &key, out))
		return 0;
	err = build(soup, kind, out);
	if (!err && keep)
		blas_store_save(store, &key, out);
	return err;
}
