#include "tracer/accel/tree.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/accel/bvh.h"

int tree_refit(const struct tree *old, const struct soup *soup, double most, struct tree *out)
{
	*out = (struct tree){ malloc(old->n_nodes * sizeof(*out->nodes)),
		              malloc(old->n_order * sizeof(*out->order) + 1), old->n_nodes, old->n_order };
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

static int box_is_sound(const struct node2 *node, int side)
{
	for (int axis = 0; axis < 3; axis++)
		if (!(node->lo[side][axis] >= -FLT_MAX && node->lo[side][axis] <= node->hi[side][axis] &&
		      node->hi[side][axis] <= FLT_MAX))
			return 0;
	return 1;
}

/* Check one side of a node. Records the depth of its child (0: not visited yet) and counts the items in leaves. */
static int side_is_sound(const struct tree *tree, uint32_t at, int side, uint8_t *depth, uint64_t *items)
{
	const uint32_t child = tree->nodes[at].child[side], count = tree->nodes[at].count[side];

	*items += count;
	if ((count || child) && !box_is_sound(&tree->nodes[at], side))
		return 0;
	if (count)
		return count <= TREE_LEAF_TRIANGLES && child <= tree->n_order && count <= tree->n_order - child;
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
