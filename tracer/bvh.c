#include "tracer/bvh.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define N_BINS 16
#define COST_NODE 1.0f /* of a node's box tests, in triangle tests */
#define THREAD_ITEMS 32768 /* subtrees smaller than this are built by their parent's thread */

/* A box with its item, moved about while the tree is built. */
struct ref {
	float lo[3];
	uint32_t item;
	float hi[3];
	uint32_t unused;
};

struct build {
	struct ref *refs;
	struct node2 *nodes; /* [n]: a subtree over refs first .. first+count-1 uses nodes in the same range only */
	uint32_t leaf_max;
};

struct bin {
	struct bvh_box box;
	uint32_t count;
};

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

static uint32_t log2_ceil(uint32_t n)
{
	uint32_t bits = 0;

	while (bits < 32 && ((uint64_t)1 << bits) < n)
		bits++;
	return bits;
}

/* Twice the centre: only comparisons matter. */
static inline float centre(const struct ref *ref, int axis)
{
	return ref->lo[axis] + ref->hi[axis];
}

struct split {
	int axis; /* -1: none */
	uint32_t bin; /* items in bins below go left */
	float cost;
};

/* Scale from centre to bin on each axis; 0 where all centres are the same. */
static void bin_scale(const struct bvh_box *centres, float scale[3])
{
	for (int a = 0; a < 3; a++) {
		float extent = centres->hi[a] - centres->lo[a];

		scale[a] = extent > 0 && N_BINS / extent < FLT_MAX ? N_BINS * 0.999f / extent : 0;
	}
}

static inline uint32_t bin_of(const struct ref *ref, int axis, float lo, float scale)
{
	int bin = (int)((centre(ref, axis) - lo) * scale);

	return bin < 0 ? 0 : bin >= N_BINS ? N_BINS - 1 : (uint32_t)bin;
}

/* The cheapest split between bins of one axis, if cheaper than *best. */
static void try_axis(struct bin bins[N_BINS], int axis, struct split *best)
{
	float right_cost[N_BINS];
	struct bvh_box box;
	uint32_t count = 0;

	bvh_box_clear(&box);
	for (int i = N_BINS - 1; i > 0; i--) {
		grow(&box, bins[i].box.lo, bins[i].box.hi);
		count += bins[i].count;
		right_cost[i] = half_area(box.lo, box.hi) * (float)count;
	}
	bvh_box_clear(&box);
	count = 0;
	for (int i = 1; i < N_BINS; i++) {
		float cost;

		grow(&box, bins[i - 1].box.lo, bins[i - 1].box.hi);
		count += bins[i - 1].count;
		cost = half_area(box.lo, box.hi) * (float)count + right_cost[i];
		if (cost < best->cost && count > 0) {
			best->axis = axis;
			best->bin = (uint32_t)i;
			best->cost = cost;
		}
	}
}

static struct split find_split(const struct ref *refs, uint32_t n, const struct bvh_box *centres)
{
	struct bin bins[3][N_BINS];
	struct split best = { -1, 0, FLT_MAX };
	float scale[3];

	bin_scale(centres, scale);
	for (int a = 0; a < 3; a++)
		for (int i = 0; i < N_BINS; i++) {
			bvh_box_clear(&bins[a][i].box);
			bins[a][i].count = 0;
		}
	for (uint32_t i = 0; i < n; i++)
		for (int a = 0; a < 3; a++) {
			struct bin *bin = &bins[a][bin_of(&refs[i], a, centres->lo[a], scale[a])];

			grow(&bin->box, refs[i].lo, refs[i].hi);
			bin->count++;
		}
	for (int a = 0; a < 3; a++)
		if (scale[a] > 0)
			try_axis(bins[a], a, &best);
	return best;
}

static uint32_t partition(struct ref *refs, uint32_t n, const struct split *split, const struct bvh_box *centres)
{
	float scale[3];
	uint32_t left = 0;

	bin_scale(centres, scale);
	for (uint32_t i = 0; i < n; i++)
		if (bin_of(&refs[i], split->axis, centres->lo[split->axis], scale[split->axis]) < split->bin) {
			struct ref ref = refs[i];

			refs[i] = refs[left];
			refs[left++] = ref;
		}
	return left;
}

static void measure(const struct ref *refs, uint32_t n, struct bvh_box *box, struct bvh_box *centres)
{
	bvh_box_clear(box);
	bvh_box_clear(centres);
	for (uint32_t i = 0; i < n; i++) {
		float c[3] = { centre(&refs[i], 0), centre(&refs[i], 1), centre(&refs[i], 2) };

		grow(box, refs[i].lo, refs[i].hi);
		grow(centres, c, c);
	}
}

/* Sort refs into two parts. Returns the size of the first; 0: they should stay one leaf. */
static uint32_t divide(const struct build *build, struct ref *refs, uint32_t n, uint32_t depth,
                       const struct bvh_box *box, const struct bvh_box *centres)
{
	const float area = half_area(box->lo, box->hi);
	struct split split;
	uint32_t left;

	if (n < 2)
		return 0;
	/* Halves by number are all that the depth left allows. */
	if (depth + log2_ceil(n) + 1 >= BVH_MAX_DEPTH)
		return n <= build->leaf_max ? 0 : n / 2;
	split = find_split(refs, n, centres);
	if (n <= build->leaf_max && (split.axis < 0 || split.cost + COST_NODE * area >= area * (float)n))
		return 0;
	if (split.axis < 0)
		return n / 2;
	left = partition(refs, n, &split, centres);
	return left == 0 || left == n ? n / 2 : left;
}

/* One side of a node: the refs first .. first+count-1, to be built into nodes slot .. slot+count-2. */
struct side {
	struct build *build;
	uint32_t first, count, slot, depth;
	struct node2 *parent;
	int side;
};

static void *build_side(void *arg)
{
	const struct side *s = arg;
	struct build *build = s->build;
	struct ref *refs = build->refs + s->first;
	struct bvh_box box, centres;
	struct side left, right;
	pthread_t thread;
	uint32_t cut;

	measure(refs, s->count, &box, &centres);
	memcpy(s->parent->lo[s->side], box.lo, sizeof(box.lo));
	memcpy(s->parent->hi[s->side], box.hi, sizeof(box.hi));
	cut = divide(build, refs, s->count, s->depth, &box, &centres);
	s->parent->child[s->side] = cut ? s->slot : s->first;
	s->parent->count[s->side] = cut ? 0 : s->count;
	if (!cut)
		return NULL;
	left = (struct side){ build, s->first, cut, s->slot + 1, s->depth + 1, &build->nodes[s->slot], 0 };
	right = (struct side){ build, s->first + cut, s->count - cut, s->slot + cut, s->depth + 1,
		               &build->nodes[s->slot], 1 };
	if (cut >= THREAD_ITEMS && pthread_create(&thread, NULL, build_side, &left) == 0) {
		build_side(&right);
		pthread_join(thread, NULL);
	} else {
		build_side(&left);
		build_side(&right);
	}
	return NULL;
}

/* The root: both sides where there are two items or more. */
static void build_root(struct build *build, uint32_t n)
{
	struct node2 *root = &build->nodes[0];
	struct bvh_box box, centres;
	struct side side = { build, 0, n, 1, 1, root, 0 };
	uint32_t cut;

	for (int i = 0; i < 2; i++) {
		bvh_box_clear(&box);
		memcpy(root->lo[i], box.lo, sizeof(box.lo));
		memcpy(root->hi[i], box.hi, sizeof(box.hi));
		root->child[i] = root->count[i] = 0;
	}
	if (n == 0)
		return;
	measure(build->refs, n, &box, &centres);
	cut = divide(build, build->refs, n, 0, &box, &centres);
	if (!cut && n > 1)
		cut = n / 2;
	if (cut) {
		build_side(&(struct side){ build, 0, cut, 1, 1, root, 0 });
		side = (struct side){ build, cut, n - cut, cut, 1, root, 1 };
	}
	build_side(&side);
}

/* Close the gaps that unused nodes left; the order stays. */
static int compact(const struct node2 *sparse, uint32_t n_sparse, struct node2 *nodes, uint32_t *n_nodes)
{
	uint32_t *place = malloc(n_sparse * sizeof(*place));
	uint32_t n = 0;

	if (!place)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < n_sparse; i++)
		if (sparse[i].child[0] != SCENE_NONE) {
			place[i] = n;
			nodes[n++] = sparse[i];
		}
	for (uint32_t i = 0; i < n; i++)
		for (int side = 0; side < 2; side++)
			if (!nodes[i].count[side] && nodes[i].child[side])
				nodes[i].child[side] = place[nodes[i].child[side]];
	free(place);
	*n_nodes = n;
	return 0;
}

int bvh_build_sah(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, struct node2 *nodes, uint32_t *n_nodes,
                  uint32_t *order)
{
	const uint32_t n_sparse = n ? n : 1;
	struct build build = { NULL, NULL, leaf_max };
	int err = 0;

	build.refs = malloc(n_sparse * sizeof(*build.refs));
	build.nodes = malloc(n_sparse * sizeof(*build.nodes));
	if (!build.refs || !build.nodes) {
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
		goto done;
	}
	for (uint32_t i = 0; i < n; i++) {
		memcpy(build.refs[i].lo, boxes[i].lo, sizeof(boxes[i].lo));
		memcpy(build.refs[i].hi, boxes[i].hi, sizeof(boxes[i].hi));
		build.refs[i].item = i;
	}
	for (uint32_t i = 0; i < n_sparse; i++)
		build.nodes[i].child[0] = SCENE_NONE; /* not used yet */
	build_root(&build, n);
	err = compact(build.nodes, n_sparse, nodes, n_nodes);
	for (uint32_t i = 0; i < n; i++)
		order[i] = build.refs[i].item;
done:
	free(build.refs);
	free(build.nodes);
	return err;
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

/* The up to eight branches below a binary node: the largest is opened until there are eight, or only leaves. */
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

/* Fill wide node `to` with what lies below binary node `from`. Recursion is as deep as the tree: BVH_MAX_DEPTH. */
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
