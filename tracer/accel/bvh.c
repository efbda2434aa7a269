#include "tracer/accel/bvh.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

void bvh_box_clear(struct bvh_box *box)
{
	for (int a = 0; a < 3; a++) {
		box->lo[a] = BVH_EMPTY_LO;
		box->hi[a] = BVH_EMPTY_HI;
	}
}

static inline void grow(struct bvh_box *box, const float lo[3], const float hi[3])
{
	for (int a = 0; a < 3; a++) {
		box->lo[a] = lo[a] < box->lo[a] ? lo[a] : box->lo[a];
		box->hi[a] = hi[a] > box->hi[a] ? hi[a] : box->hi[a];
	}
}

void bvh_box_join(struct bvh_box *box, const struct bvh_box *other)
{
	grow(box, other->lo, other->hi);
}

static float half_area(const float lo[3], const float hi[3])
{
	float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];

	return x < 0 ? 0 : x * y + y * z + z * x;
}

double bvh_cost(const struct node2 *nodes, uint32_t n_nodes)
{
	struct bvh_box box;
	double root, sum = 0;

	bvh_box_clear(&box);
	for (int side = 0; side < 2; side++)
		grow(&box, nodes[0].lo[side], nodes[0].hi[side]);
	root = half_area(box.lo, box.hi);
	for (uint32_t i = 0; i < n_nodes; i++)
		for (int side = 0; side < 2; side++)
			sum += (double)half_area(nodes[i].lo[side], nodes[i].hi[side]) *
			       (nodes[i].count[side] ? nodes[i].count[side] : BVH_COST_NODE);
	return root > 0 ? BVH_COST_NODE + sum / root : BVH_COST_NODE;
}

/* Compute the box of one side. The boxes of its child are already up to date. */
static struct bvh_box fit_side(const struct node2 *nodes, const struct node2 *node, int side,
                               const struct bvh_box *boxes, const uint32_t *order)
{
	struct bvh_box box;

	bvh_box_clear(&box);
	for (uint32_t i = 0; i < node->count[side]; i++)
		bvh_box_join(&box, &boxes[order[node->child[side] + i]]);
	for (int s = 0; s < 2 && !node->count[side] && node->child[side]; s++)
		grow(&box, nodes[node->child[side]].lo[s], nodes[node->child[side]].hi[s]);
	return box;
}

void bvh_refit(struct node2 *nodes, uint32_t n_nodes, const struct bvh_box *boxes, const uint32_t *order)
{
	for (uint32_t i = n_nodes; i-- > 0;)
		for (int side = 0; side < 2; side++) {
			const struct bvh_box box = fit_side(nodes, &nodes[i], side, boxes, order);

			memcpy(nodes[i].lo[side], box.lo, sizeof(box.lo));
			memcpy(nodes[i].hi[side], box.hi, sizeof(box.hi));
		}
}

/* A subtree to be collapsed: one side of a binary node. */
struct branch {
	const struct node2 *node;
	int side;
};

struct collapse {
	const struct node2 *nodes2;
	enum bvh_leaves leaves;
	struct node8 *nodes;
	uint32_t n_nodes;
	uint32_t *block_first, *block_count, n_blocks;
	uint32_t *first, *count; /* per binary node: its items in leaf order */
};

static uint32_t branch_count(const struct collapse *c, struct branch b)
{
	return b.node->count[b.side] ? b.node->count[b.side] : c->count[b.node->child[b.side]];
}

static uint32_t branch_first(const struct collapse *c, struct branch b)
{
	return b.node->count[b.side] ? b.node->child[b.side] : c->first[b.node->child[b.side]];
}

static int branch_is_leaf(const struct collapse *c, struct branch b)
{
	return b.node->count[b.side] || (c->leaves == BVH_BLOCKS && branch_count(c, b) <= 8);
}

static int branch_is_empty(struct branch b)
{
	return !b.node->count[b.side] && !b.node->child[b.side];
}

/* Collect up to eight branches below a binary node: open the largest until there are eight, or only leaves are left. */
static int open_branches(const struct collapse *c, const struct node2 *node, struct branch out[8])
{
	int n = 0;

	for (int side = 0; side < 2; side++)
		if (!branch_is_empty((struct branch){ node, side }))
			out[n++] = (struct branch){ node, side };
	while (n < 8) {
		float largest = -1;
		int open = -1;

		for (int i = 0; i < n; i++) {
			float area = half_area(out[i].node->lo[out[i].side], out[i].node->hi[out[i].side]);

			if (!branch_is_leaf(c, out[i]) && area > largest) {
				largest = area;
				open = i;
			}
		}
		if (open < 0)
			break;
		node = &c->nodes2[out[open].node->child[out[open].side]];
		out[open] = (struct branch){ node, 0 };
		out[n++] = (struct branch){ node, 1 };
	}
	return n;
}

/* Fill wide node `to` with the branches below binary node `from`. Recursion is at most BVH_MAX_DEPTH deep, like the
 * tree. */
static void collapse_node(struct collapse *c, uint32_t from, uint32_t to)
{
	struct branch branches[8];
	int n = open_branches(c, &c->nodes2[from], branches);

	for (int i = 0; i < 8; i++) {
		struct node8 *out = &c->nodes[to];

		for (int a = 0; a < 3; a++) {
			out->lo[a][i] = i < n ? branches[i].node->lo[branches[i].side][a] : BVH_EMPTY_LO;
			out->hi[a][i] = i < n ? branches[i].node->hi[branches[i].side][a] : BVH_EMPTY_HI;
		}
		out->child[i] = out->count[i] = 0;
		if (i >= n)
			continue;
		if (!branch_is_leaf(c, branches[i])) {
			out->child[i] = c->n_nodes++;
		} else if (c->leaves == BVH_ITEMS) {
			out->child[i] = branch_first(c, branches[i]);
			out->count[i] = branch_count(c, branches[i]);
		} else {
			c->block_first[c->n_blocks] = branch_first(c, branches[i]);
			c->block_count[c->n_blocks] = branch_count(c, branches[i]);
			out->child[i] = c->n_blocks++;
			out->count[i] = 1;
		}
	}
	for (int i = 0; i < n; i++)
		if (!branch_is_leaf(c, branches[i]))
			collapse_node(c, branches[i].node->child[branches[i].side], c->nodes[to].child[i]);
}

int bvh_collapse8(const struct node2 *nodes2, uint32_t n_nodes2, enum bvh_leaves leaves, struct node8 *nodes,
                  uint32_t *n_nodes, uint32_t *block_first, uint32_t *block_count, uint32_t *n_blocks)
{
	struct collapse c = { nodes2, leaves, nodes, 1, block_first, block_count, 0, NULL, NULL };
	int err = 0;

	c.first = malloc(n_nodes2 * sizeof(*c.first));
	c.count = malloc(n_nodes2 * sizeof(*c.count));
	if (!c.first || !c.count) {
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
		goto done;
	}
	/* Children come after their parents. */
	for (uint32_t i = n_nodes2; i-- > 0;) {
		struct branch left = { &nodes2[i], 0 }, right = { &nodes2[i], 1 };

		c.first[i] = branch_is_empty(left) ? 0 : branch_first(&c, left);
		c.count[i] = (branch_is_empty(left) ? 0 : branch_count(&c, left)) +
		             (branch_is_empty(right) ? 0 : branch_count(&c, right));
	}
	collapse_node(&c, 0, 0);
	*n_nodes = c.n_nodes;
	if (n_blocks)
		*n_blocks = c.n_blocks;
done:
	free(c.first);
	free(c.count);
	return err;
}
