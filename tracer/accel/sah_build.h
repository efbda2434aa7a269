/*
 * The binned builder, a text that is compiled as SAH_BUILD for what its includers are compiled for. Boxes are moved about as 32-byte references; a subtree's references and nodes lie in one range each,
 * so that threads never meet. Passes over the references: one that bins all three axes, one that sorts them into the two
 * sides and bounds the sides' centres; the sides' boxes come from the bins.
 */
#include "tracer/accel/bvh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/accel/forks.h"
#include "tracer/accel/box8.h"

#define MAX_BINS 32
#define SMALL 4 /* parts of so many are divided the best of all ways; not to be changed alone */
#define CHUNK 16384
#define GRAIN 4096 /* both sides of a node have as many at least: another thread may take one of them */

/* A box with its item in lane 3 of the lower half, where it is an ordinary float: denormal ones slow arithmetic down. */
#define ITEM_IS_FLOAT 0x40000000u
#define MOST_ITEMS 0x3f000000u

static inline uint32_t item_of(box8 ref)
{
	return (uint32_t)((ivec4)box8_negative_lo(ref))[3] & ~ITEM_IS_FLOAT;
}

/* What is known of a subtree before it is built: `count` references at `first`, and room for `room` of them. */
struct part {
	uint32_t first, count, room, depth;
	box8 box, centres; /* twice the centres: only comparisons matter */
};

#include "tracer/accel/sbvh_split.h"
#include "tracer/accel/kd_split.h"

/* Nodes that one thread filled one after the other, from `first` on; `used` of them. */
struct run {
	uint32_t first, used;
	uint32_t place; /* where `first` comes to lie when the gaps are closed */
};

struct build {
	const struct bvh_box *boxes;
	enum bvh_splits splits;
	const struct triangle *triangles; /* in the boxes; NULL with BVH_OBJECTS */
	float least_overlap;              /* half area of what sides share from which on space is cut */
	uint32_t *order;
	box8 *refs;
	struct node2 *nodes; /* [n]: a subtree with room for `room` references uses nodes in a range of room-1 only */
	uint32_t leaf_max, most_bins;
	struct forks forks;
	struct part *chunks; /* bounds of each CHUNK boxes, for a start */
	struct run *runs;
	uint32_t n_runs;
};

/* A subtree for any thread: its nodes begin at `slot`. */
struct fork_part {
	struct part part;
	uint32_t slot;
};

/* The bins of one number of all three axes. */
struct bin {
	box8 box[3];
	ivec4 count; /* lanes 0 to 2: of the axes */
	ivec4 unused; /* makes the size a power of two */
};

struct split {
	float cost; /* of both sides, areas not divided by the node's; FLT_MAX: none */
	int axis;
	uint32_t bin; /* items in bins below go left */
};

static void measure(const box8 *refs, uint32_t n, struct part *part)
{
	part->box = part->centres = box8_empty();
	for (uint32_t i = 0; i < n; i++) {
		const vec4 c = box8_centre(refs[i]);

		part->box = box8_join(refs[i], part->box);
		part->centres = box8_join(box8_make(-c, c), part->centres);
	}
}

/* Few items get few bins: their cost is then that of the bins. */
static uint32_t bins_for(uint32_t n, uint32_t most)
{
	const uint32_t bins = 4 + n / 8;

	return bins < most ? bins : most;
}

/* Scale from centre to bin on each axis; 0 where all centres are the same. */
static vec4 bin_scale(box8 centres, uint32_t bins)
{
	const float b = (float)bins;
	const vec4 width = box8_size(centres);
	vec4 scale = VEC4(0);

	for (int a = 0; a < 3; a++)
		if (width[a] > 0 && b / width[a] < FLT_MAX)
			scale[a] = b * 0.999f / width[a];
	return scale;
}

static inline void bin_item(struct bin *bins, box8 ref, vec4 lo, vec4 scale)
{
	/* Offsets in bytes, worked out for the three axes at once. */
	const ivec4 at = __builtin_convertvector((box8_centre(ref) - lo) * scale, ivec4) * (int32_t)sizeof(*bins);
	struct bin *x = (struct bin *)((char *)bins + (uint32_t)at[0]), *y = (struct bin *)((char *)bins + (uint32_t)at[1]),
	           *z = (struct bin *)((char *)bins + (uint32_t)at[2]);

	x->box[0] = box8_join(ref, x->box[0]);
	y->box[1] = box8_join(ref, y->box[1]);
	z->box[2] = box8_join(ref, z->box[2]);
	((int32_t *)&x->count)[0]++;
	((int32_t *)&y->count)[1]++;
	((int32_t *)&z->count)[2]++;
}

static inline void clear_bins(struct bin *bins, uint32_t n_bins)
{
	for (uint32_t i = 0; i < n_bins; i++)
		bins[i] = (struct bin){ { box8_empty(), box8_empty(), box8_empty() }, { 0 }, { 0 } };
}

static void fill_bins(struct bin *bins, uint32_t n_bins, const box8 *refs, uint32_t n, vec4 lo, vec4 scale)
{
	struct bin more[MAX_BINS];

	clear_bins(bins, n_bins);
	if (n < 8 * MAX_BINS) {
		for (uint32_t i = 0; i < n; i++)
			bin_item(bins, refs[i], lo, scale);
		return;
	}
	/* Neighbours tend to fall into the same bin: two sets of bins, so that one need not wait for the other. */
	clear_bins(more, n_bins);
	for (uint32_t i = 0; i + 1 < n; i += 2) {
		bin_item(bins, refs[i], lo, scale);
		bin_item(more, refs[i + 1], lo, scale);
	}
	if (n % 2)
		bin_item(bins, refs[n - 1], lo, scale);
	for (uint32_t i = 0; i < n_bins; i++) {
		for (int a = 0; a < 3; a++)
			bins[i].box[a] = box8_join(bins[i].box[a], more[i].box[a]);
		bins[i].count += more[i].count;
	}
}

/* The cheapest plane between two bins of any axis: lanes 0 to 2 are the axes. */
static struct split sweep(const struct bin *bins, uint32_t n_bins, vec4 scale)
{
	box8 x = box8_empty(), y = x, z = x;
	vec4 right[MAX_BINS], best = VEC4(FLT_MAX), best_at = VEC4(0), at = VEC4(0);
	ivec4 count = { 0 };
	struct split split = { FLT_MAX, 0, 0 };

	for (uint32_t i = n_bins - 1; i > 0; i--) {
		x = box8_join(bins[i].box[0], x);
		y = box8_join(bins[i].box[1], y);
		z = box8_join(bins[i].box[2], z);
		count += bins[i].count;
		right[i] = box8_half_areas(x, y, z, z) * __builtin_convertvector(count, vec4);
	}
	x = y = z = box8_empty();
	count = (ivec4){ 0 };
	for (uint32_t i = 1; i < n_bins; i++) {
		vec4 cost;
		ivec4 less;

		x = box8_join(bins[i - 1].box[0], x);
		y = box8_join(bins[i - 1].box[1], y);
		z = box8_join(bins[i - 1].box[2], z);
		count += bins[i - 1].count;
		cost = box8_half_areas(x, y, z, z) * __builtin_convertvector(count, vec4) + right[i];
		at += 1;
		less = cost < best;
		best = vec4_min(cost, best);
		best_at = vec4_max((vec4)((ivec4)at & less), best_at); /* later ones are higher */
	}
	for (int a = 0; a < 3; a++)
		if (scale[a] > 0 && best[a] < split.cost) {
			split.cost = best[a];
			split.axis = a;
			split.bin = (uint32_t)best_at[a];
		}
	return split;
}

/* Sort by bin; the parts get their counts and their centres' bounds. Compiled for each axis. */
static inline __attribute__((always_inline)) void partition_axis(box8 *refs, uint32_t n, const int axis, float limit, vec4 lo,
                                                                 vec4 scale, struct part *left, struct part *right)
{
	box8 l = box8_empty(), r = l;
	uint32_t n_left = 0;

	for (uint32_t i = 0; i < n; i++) {
		const box8 ref = refs[i];
		const vec4 c = box8_centre(ref), bin = (c - lo) * scale;
		const ivec4 goes_left = __builtin_shuffle(bin, (ivec4){ axis, axis, axis, axis }) < VEC4(limit);
		/* A NaN where the centre is of the other side: it changes nothing. */
		const vec4 c_left = (vec4)((ivec4)c | ~goes_left), c_right = (vec4)((ivec4)c | goes_left);

		refs[i] = refs[n_left];
		refs[n_left] = ref;
		n_left += vec4_first(goes_left);
		l = box8_join(box8_make(-c_left, c_left), l);
		r = box8_join(box8_make(-c_right, c_right), r);
	}
	left->centres = l;
	right->centres = r;
	left->count = n_left;
	right->count = n - n_left;
}

static void partition(box8 *refs, uint32_t n, const struct split *split, vec4 lo, vec4 scale, struct part *left,
                      struct part *right)
{
	const float limit = (float)split->bin;

	switch (split->axis) {
	case 0:
		partition_axis(refs, n, 0, limit, lo, scale, left, right);
		break;
	case 1:
		partition_axis(refs, n, 1, limit, lo, scale, left, right);
		break;
	default:
		partition_axis(refs, n, 2, limit, lo, scale, left, right);
	}
}

static uint32_t log2_ceil(uint32_t n)
{
	return n < 2 ? 0 : 32 - (uint32_t)__builtin_clz(n - 1);
}

/* The lowest of the first n lanes. */
static inline int lowest(vec4 v, int n)
{
	int best = 0;

	for (int i = 1; i < n; i++)
		best = v[i] < v[best] ? i : best;
	return best;
}

static inline void swap(box8 *refs, int i, int j)
{
	const box8 ref = refs[i];

	refs[i] = refs[j];
	refs[j] = ref;
}

/*
 * The best of all ways to divide two to SMALL references, sorted so that the left side's come first. Returns the cost as struct
 * split has it. Parts this small need no bounds of centres.
 */
static float divide_small(box8 *refs, uint32_t n, struct part *left, struct part *right)
{
	const box8 *b = refs;
	box8 p[3], q[3], t[4];
	vec4 area, cost, pair_cost;
	float best;
	int k;

	left->count = 1;
	right->count = n - 1;
	if (n == 2) {
		left->box = b[0];
		right->box = b[1];
		area = box8_half_areas(b[0], b[1], b[1], b[1]);
		return area[0] + area[1];
	}
	p[0] = box8_join(b[1], b[2]);
	p[1] = box8_join(b[0], b[2]);
	p[2] = box8_join(b[0], b[1]);
	if (n == 3) {
		cost = box8_half_areas(b[0], b[1], b[2], b[2]) + 2 * box8_half_areas(p[0], p[1], p[2], p[2]);
		k = lowest(cost, 3);
		left->box = b[k];
		right->box = p[k];
		swap(refs, 0, k);
		return cost[k];
	}
	for (int i = 0; i < 3; i++) {
		q[i] = box8_join(b[i], b[3]);
		t[i] = box8_join(p[i], b[3]);
	}
	t[3] = box8_join(p[0], b[0]);
	cost = box8_half_areas(b[0], b[1], b[2], b[3]) + 3 * box8_half_areas(t[0], t[1], t[2], t[3]);
	k = lowest(cost, 4);
	best = cost[k];
	pair_cost = 2 * (box8_half_areas(p[0], p[1], p[2], p[2]) + box8_half_areas(q[0], q[1], q[2], q[2]));
	if (best <= pair_cost[lowest(pair_cost, 3)]) {
		left->box = b[k];
		right->box = t[k];
		swap(refs, 0, k);
		return best;
	}
	k = lowest(pair_cost, 3);
	left->count = right->count = 2;
	left->box = q[k];
	right->box = p[k];
	/* k and 3 to the front. */
	swap(refs, 0, k);
	swap(refs, 1, 3);
	return pair_cost[k];
}

/* Where two parts come to lie: the room that is left is shared, the references of the right one that are in the way move. */
static void lay_out(const struct build *build, const struct part *part, struct part *left, struct part *right)
{
	const uint32_t n = left->count + right->count, spare = part->room - n;
	const uint32_t gap = (uint32_t)((uint64_t)spare * left->count / n), moved = gap < right->count ? gap : right->count;
	box8 *refs = build->refs + part->first;

	left->first = part->first;
	left->room = left->count + gap;
	right->first = left->first + left->room;
	right->room = part->room - left->room;
	left->depth = right->depth = part->depth + 1;
	for (uint32_t i = 0; i < moved; i++)
		refs[left->room + right->count - moved + i] = refs[left->count + i];
}

/* Halves by number, where the heuristic has nothing to say. */
static void halve(const struct build *build, const struct part *part, struct part *left, struct part *right)
{
	left->count = part->count / 2;
	right->count = part->count - left->count;
	measure(build->refs + part->first, left->count, left);
	measure(build->refs + part->first + left->count, right->count, right);
}

/* The boxes of both sides of a split between bins. */
static void split_boxes(const struct bin *bins, uint32_t n_bins, const struct split *split, struct part *left, struct part *right)
{
	left->box = right->box = box8_empty();
	for (uint32_t i = 0; i < n_bins; i++) {
		struct part *side = i < split->bin ? left : right;

		side->box = box8_join(bins[i].box[split->axis], side->box);
	}
}

/* Cut space where that is cheaper than the split that there is, whose sides' boxes are in the parts. 0: it is not. */
static int divide_space(const struct build *build, const struct part *part, float cost, struct part *left, struct part *right)
{
	const box8 both = box8_meet(left->box, right->box);
	box8 *refs = build->refs + part->first;
	struct plane plane;

	if (cost < FLT_MAX && !(box8_is_box(both) && box8_half_area(both) > build->least_overlap))
		return 0;
	plane = find_plane(build->triangles, refs, part->count, part->box);
	if (!(plane.cost < cost) ||
	    !partition_space(build->triangles, refs, part->count, part->room, &plane, 1, left, right))
		return 0;
	measure(refs, left->count, left);
	measure(refs + left->count, right->count, right);
	return 1;
}

/* Cut a cell in two. 0: there is no plane, or none that is worth it; then a few stay one leaf. */
static int divide_cell(const struct build *build, const struct part *part, int may, struct part *left, struct part *right)
{
	const float area = box8_half_area(part->box), whole = area * (float)part->count;
	box8 *refs = build->refs + part->first;
	const struct plane plane = find_kd_plane(refs, part->count, part->box);

	if (!(plane.cost + (may ? BVH_COST_NODE * area : 0) < whole) ||
	    part->count + kd_count_cut(refs, part->count, &plane) > part->room ||
	    !partition_space(build->triangles, refs, part->count, part->room, &plane, 0, left, right))
		return 0;
	measure(refs, left->count, left);
	measure(refs + left->count, right->count, right);
	return 1;
}

/* Sort the references into two parts, which get their counts, boxes and bounds of centres. 0: they should stay one leaf. */
static int divide_refs(const struct build *build, const struct part *part, int must, struct part *left, struct part *right)
{
	const uint32_t n = part->count, n_bins = bins_for(n, build->most_bins);
	const int may = n <= build->leaf_max && !must;
	const float area = box8_half_area(part->box);
	box8 *refs = build->refs + part->first;
	struct bin bins[MAX_BINS];
	struct split split;
	vec4 scale, lo;

	/* Halves by number are all that the depth left allows. */
	if (part->depth + log2_ceil(n) + 1 >= BVH_MAX_DEPTH) {
		if (may)
			return 0;
		halve(build, part, left, right);
		return 1;
	}
	if (build->splits == BVH_PLANES) {
		if (divide_cell(build, part, may, left, right))
			return 1;
		if (may)
			return 0;
	}
	if (n <= SMALL) {
		const float cost = divide_small(refs, n, left, right);

		return !may || cost + BVH_COST_NODE * area < area * (float)n;
	}
	lo = -box8_negative_lo(part->centres);
	scale = bin_scale(part->centres, n_bins);
	fill_bins(bins, n_bins, refs, n, lo, scale);
	split = sweep(bins, n_bins, scale);
	if (may && split.cost + BVH_COST_NODE * area >= area * (float)n)
		return 0;
	split_boxes(bins, n_bins, &split, left, right);
	if (build->splits == BVH_SPATIAL && part->room > n && divide_space(build, part, split.cost, left, right))
		return 1;
	if (split.cost == FLT_MAX) {
		halve(build, part, left, right);
		return 1;
	}
	partition(refs, n, &split, lo, scale, left, right);
	if (left->count == 0 || right->count == 0)
		halve(build, part, left, right);
	else
		split_boxes(bins, n_bins, &split, left, right);
	return 1;
}

/* Divide a part in two. 0: it should stay one leaf. */
static int divide(const struct build *build, const struct part *part, int must, struct part *left, struct part *right)
{
	if (part->count < 2 || !divide_refs(build, part, must, left, right))
		return 0;
	lay_out(build, part, left, right);
	return 1;
}

static void set_box(struct node2 *node, int side, box8 box)
{
	const vec4 lo = -box8_negative_lo(box), hi = box8_hi(box);

	for (int a = 0; a < 3; a++) {
		node->lo[side][a] = lo[a];
		node->hi[side][a] = hi[a];
	}
}

static void build_node(struct build *build, struct run *run, uint32_t slot, const struct part sides[2]);

/* One side of node `at`, by this thread. slot: where its nodes would begin if all room were taken. */
static void build_side(struct build *build, struct run *run, uint32_t at, int side, uint32_t slot, const struct part *part)
{
	struct node2 *node = &build->nodes[at];
	struct part sides[2];

	set_box(node, side, part->box);
	if (!divide(build, part, 0, &sides[0], &sides[1])) {
		node->child[side] = part->first;
		node->count[side] = part->count;
		for (uint32_t i = part->first; i < part->first + part->count; i++)
			build->order[i] = item_of(build->refs[i]);
		return;
	}
	node->child[side] = run->first + run->used;
	node->count[side] = 0;
	build_node(build, run, slot, sides);
}

/*
 * The run's next node, over two parts; slot: where it would lie if all room took nodes. Of sides that both are large,
 * the second goes to whoever is free, into a run of its own behind all that the first can take. Else the smaller one is
 * built first: it has no runs of its own, behind which nothing may follow.
 */
static void build_node(struct build *build, struct run *run, uint32_t slot, const struct part sides[2])
{
	const uint32_t at = run->first + run->used++;
	const int first = sides[0].room > sides[1].room;

	if (sides[0].room >= GRAIN && sides[1].room >= GRAIN) {
		const struct fork_part fork = { sides[1], slot + sides[0].room };
		struct node2 *node = &build->nodes[at];

		set_box(node, 1, sides[1].box);
		node->child[1] = fork.slot;
		node->count[1] = 0;
		forks_add(&build->forks, &fork);
		build_side(build, run, at, 0, slot + 1, &sides[0]);
		return;
	}
	build_side(build, run, at, first, slot + 1, &sides[first]);
	build_side(build, run, at, !first, slot + sides[first].room, &sides[!first]);
}

static void build_fork(void *arg, const void *task)
{
	struct build *build = arg;
	const struct fork_part *fork = task;
	struct run *run = &build->runs[__atomic_fetch_add(&build->n_runs, 1, __ATOMIC_RELAXED)];
	struct part sides[2];

	run->first = fork->slot;
	run->used = 0;
	/* A root has two sides where there are two items. */
	divide(build, &fork->part, 1, &sides[0], &sides[1]);
	build_node(build, run, fork->slot, sides);
}

/* References to a chunk of the boxes, and bounds of them all. */
static void make_refs(void *arg, const void *task)
{
	struct build *build = arg;
	const struct part *chunk = &((const struct fork_part *)task)->part;

	for (uint32_t i = chunk->first; i < chunk->first + chunk->count; i++) {
		const struct bvh_box *b = &build->boxes[i];
		const vec4 negative_lo = { -b->lo[0], -b->lo[1], -b->lo[2], 0 }, hi = { b->hi[0], b->hi[1], b->hi[2], 0 };

		build->refs[i] = box8_make((vec4)((ivec4)negative_lo | (ivec4){ 0, 0, 0, (int32_t)(i | ITEM_IS_FLOAT) }), hi);
	}
	measure(build->refs + chunk->first, chunk->count, &build->chunks[chunk->first / CHUNK]);
}

static int compare_runs(const void *a, const void *b)
{
	const struct run *x = a, *y = b;

	return (x->first > y->first) - (x->first < y->first);
}

/* Where a node comes to lie. A run knows its own; others are only ever entered at their first. */
static uint32_t new_place(const struct build *build, const struct run *own, uint32_t node)
{
	const struct run key = { .first = node };

	if (node - own->first < own->used)
		return own->place + (node - own->first);
	return ((const struct run *)bsearch(&key, build->runs, build->n_runs, sizeof(key), compare_runs))->place;
}

/* Close the gaps between runs; the order stays, whoever built them. */
static uint32_t close_gaps(struct build *build)
{
	uint32_t n = 0;

	qsort(build->runs, build->n_runs, sizeof(*build->runs), compare_runs);
	for (uint32_t i = 0; i < build->n_runs; i++) {
		build->runs[i].place = n;
		n += build->runs[i].used;
	}
	for (uint32_t i = 0; i < build->n_runs; i++) {
		const struct run *run = &build->runs[i];

		for (uint32_t k = 0; k < run->used; k++) {
			struct node2 node = build->nodes[run->first + k];

			for (int side = 0; side < 2; side++)
				if (!node.count[side])
					node.child[side] = new_place(build, run, node.child[side]);
			build->nodes[run->place + k] = node;
		}
	}
	return n;
}

/* Close the gaps that unused room left in the order of the leaves, where unused places hold SCENE_NONE. */
static int close_order(struct build *build, uint32_t room, uint32_t n_nodes, uint32_t *n_order)
{
	uint32_t *place = malloc(room * sizeof(*place)), n = 0;

	if (!place)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < room; i++) {
		place[i] = n;
		if (build->order[i] != SCENE_NONE)
			build->order[n++] = build->order[i];
	}
	for (uint32_t i = 0; i < n_nodes; i++)
		for (int side = 0; side < 2; side++)
			if (build->nodes[i].count[side])
				build->nodes[i].child[side] = place[build->nodes[i].child[side]];
	free(place);
	*n_order = n;
	return 0;
}

/* Fewer than two items: a root with an empty side. */
static void build_tiny(const struct bvh_box *boxes, uint32_t n, struct node2 *root, uint32_t *order)
{
	for (int side = 0; side < 2; side++) {
		set_box(root, side, box8_empty());
		root->child[side] = root->count[side] = 0;
	}
	if (n) {
		memcpy(root->lo[0], boxes->lo, sizeof(boxes->lo));
		memcpy(root->hi[0], boxes->hi, sizeof(boxes->hi));
		root->count[0] = 1;
		order[0] = 0;
	}
}

/**
 * @param triangles  NULL with BVH_OBJECTS, where room is n
 * @param most_bins  at most MAX_BINS
 */
int SAH_BUILD(enum bvh_splits splits, const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, uint32_t most_bins,
              unsigned threads, uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order);

int SAH_BUILD(enum bvh_splits splits, const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, uint32_t most_bins,
              unsigned threads, uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order)
{
	const uint32_t most_runs = room / GRAIN + n / CHUNK + 1;
	struct build build = { .boxes = boxes, .splits = splits, .triangles = triangles, .order = order, .nodes = nodes, .leaf_max = leaf_max,
	                       .most_bins = most_bins };
	struct fork_part all = { .part = { .count = n, .room = room } };
	int err = 0;

	if (room > MOST_ITEMS)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: a mesh of %u triangles is too large", n);
	*n_order = n;
	if (n < 2) {
		build_tiny(boxes, n, nodes, order);
		*n_nodes = 1;
		return 0;
	}
	build.refs = aligned_alloc(32, room * sizeof(*build.refs));
	build.chunks = aligned_alloc(32, ((n / CHUNK + 1) * sizeof(*build.chunks) + 31) / 32 * 32);
	build.runs = malloc(most_runs * sizeof(*build.runs));
	if (!build.refs || !build.chunks || !build.runs)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (n < 2 * GRAIN)
		threads = 1;
	if (!err)
		err = forks_init(&build.forks, sizeof(all), most_runs);
	if (err)
		goto done;
	for (uint32_t first = 0; first < n; first += CHUNK) {
		const struct fork_part chunk = { { .first = first, .count = n - first < CHUNK ? n - first : CHUNK }, 0 };

		forks_add(&build.forks, &chunk);
	}
	forks_run(&build.forks, threads, make_refs, &build);
	all.part.box = all.part.centres = box8_empty();
	for (uint32_t i = 0; i * CHUNK < n; i++) {
		all.part.box = box8_join(build.chunks[i].box, all.part.box);
		all.part.centres = box8_join(build.chunks[i].centres, all.part.centres);
	}
	build.least_overlap = SPATIAL_OVERLAP * box8_half_area(all.part.box);
	if (triangles)
		memset(order, 0xff, room * sizeof(*order));
	forks_add(&build.forks, &all);
	forks_run(&build.forks, threads, build_fork, &build);
	*n_nodes = close_gaps(&build);
	if (triangles)
		err = close_order(&build, room, *n_nodes, n_order);
done:
	forks_free(&build.forks);
	free(build.runs);
	free(build.chunks);
	free(build.refs);
	return err;
}
