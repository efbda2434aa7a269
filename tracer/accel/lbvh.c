/*
 * Linear bounding volume hierarchies (Lauterbach et al. 2009, "Fast BVH construction on GPUs"): items are sorted along
 * a Morton curve and divided at the highest bit that changes.
 *
 * One thread lays out the top levels, down to parts of GRAIN items. Then threads take parts and fill a range of nodes
 * for each. The contents of every node depend only on the sorted codes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/accel/box8.h"
#include "tracer/accel/builders.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/forks.h"

#define AXIS_BITS 14 /* bits of a code per axis; sorting takes four passes */
#define DIGIT_BITS 11
#define DIGITS (1u << DIGIT_BITS)
#define PASSES 4
#define GRAIN 4096u
#define SORT_ALONE 65536u /* fewer items are sorted by one thread: several would wait for each other after each pass */
#define IS_PART 0xffffffffu

/* An item and the position of its centre on the curve. */
struct place {
	uint64_t code; /* 3 * AXIS_BITS bits */
	uint32_t item;
};

/* A subtree that one thread fills: items first .. first + count - 1, and `used` nodes from `first` on. */
struct part {
	uint32_t first, count, depth;
	uint32_t used, place; /* place: final position of its nodes */
	uint32_t child, n_items; /* child and count for its parent, with nodes numbered by current position */
	box8 box;
};

struct build {
	const struct bvh_box *boxes;
	uint32_t n, leaf_max;
	struct place *from, *to; /* for sorting; they swap after each pass */
	uint32_t *counts;        /* [chunk][DIGITS]: number of items with a digit, then their position */
	uint32_t chunk, n_chunks, shift;
	struct bvh_box *bounds;  /* [chunk] around centres */
	float lo[3], scale;
	box8 *sorted;            /* [n] boxes in the order of sorted items, so nodes read them sequentially */
	struct node2 *nodes;     /* [n - 1] nodes of the parts */
	struct node2 *out;
	struct part *parts;
	uint32_t n_parts;
	uint32_t *order;
};

/* --- Sorting ----------------------------------------------------------------------------------------------------- */

static uint64_t spread(uint64_t x)
{
	x = (x | x << 16) & 0x0000ff0000ffull;
	x = (x | x << 8) & 0x00f00f00f00full;
	x = (x | x << 4) & 0x0c30c30c30c3ull;
	return (x | x << 2) & 0x249249249249ull;
}

static float centre(const struct bvh_box *box, int axis)
{
	return 0.5f * box->lo[axis] + 0.5f * box->hi[axis];
}

static uint32_t chunk_end(const struct build *b, uint32_t chunk)
{
	const uint32_t end = (chunk + 1) * b->chunk;

	return end < b->n ? end : b->n;
}

static void find_bounds(void *arg, const void *task)
{
	struct build *b = arg;
	const uint32_t chunk = *(const uint32_t *)task;
	struct bvh_box bounds = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

	for (uint32_t i = chunk * b->chunk; i < chunk_end(b, chunk); i++)
		for (int a = 0; a < 3; a++) {
			const float at = centre(&b->boxes[i], a);

			bounds.lo[a] = at < bounds.lo[a] ? at : bounds.lo[a];
			bounds.hi[a] = at > bounds.hi[a] ? at : bounds.hi[a];
		}
	b->bounds[chunk] = bounds;
}

/* Cells of the curve are cubes: a short axis matters only at small cells. */
static void set_scale(struct build *b)
{
	struct bvh_box all = b->bounds[0];
	float widest = 0;

	for (uint32_t i = 1; i < b->n_chunks; i++)
		bvh_box_join(&all, &b->bounds[i]);
	for (int a = 0; a < 3; a++)
		widest = all.hi[a] - all.lo[a] > widest ? all.hi[a] - all.lo[a] : widest;
	memcpy(b->lo, all.lo, sizeof(b->lo));
	b->scale = widest > 0 ? (1 << AXIS_BITS) / widest : 0;
}

static void make_codes(void *arg, const void *task)
{
	struct build *b = arg;
	const uint32_t chunk = *(const uint32_t *)task;

	for (uint32_t i = chunk * b->chunk; i < chunk_end(b, chunk); i++) {
		uint64_t code = 0;

		for (int a = 0; a < 3; a++) {
			const float at = (centre(&b->boxes[i], a) - b->lo[a]) * b->scale;

			code |= spread((uint64_t)(at > 0 ? at < (1 << AXIS_BITS) - 1 ? at : (1 << AXIS_BITS) - 1 : 0)) << a;
		}
		b->from[i] = (struct place){ code, i };
	}
}

static uint32_t digit(const struct build *b, uint64_t code)
{
	return (uint32_t)(code >> b->shift) & (DIGITS - 1);
}

static void count_digits(void *arg, const void *task)
{
	struct build *b = arg;
	const uint32_t chunk = *(const uint32_t *)task;
	uint32_t *counts = b->counts + (size_t)chunk * DIGITS;

	memset(counts, 0, DIGITS * sizeof(*counts));
	for (uint32_t i = chunk * b->chunk; i < chunk_end(b, chunk); i++)
		counts[digit(b, b->from[i].code)]++;
}

static void move_items(void *arg, const void *task)
{
	struct build *b = arg;
	const uint32_t chunk = *(const uint32_t *)task;
	uint32_t *places = b->counts + (size_t)chunk * DIGITS;

	for (uint32_t i = chunk * b->chunk; i < chunk_end(b, chunk); i++)
		b->to[places[digit(b, b->from[i].code)]++] = b->from[i];
}

/* Run tasks 0 .. n - 1: chunks or parts. */
static void run_all(struct build *b, uint32_t n, struct forks *forks, unsigned threads, forks_do *run)
{
	for (uint32_t i = 0; i < n; i++)
		forks_add(forks, &i);
	forks_run(forks, threads, run, b);
}

/* Sort by code, equal codes by item: each pass keeps the order of the one before. */
static void sort(struct build *b, struct forks *forks, unsigned threads)
{
	run_all(b, b->n_chunks, forks, threads, find_bounds);
	set_scale(b);
	run_all(b, b->n_chunks, forks, threads, make_codes);
	for (int pass = 0; pass < PASSES; pass++) {
		struct place *swap = b->from;
		uint32_t sum = 0;

		b->shift = (uint32_t)pass * DIGIT_BITS;
		run_all(b, b->n_chunks, forks, threads, count_digits);
		for (uint32_t d = 0; d < DIGITS; d++)
			for (uint32_t i = 0; i < b->n_chunks; i++) {
				const uint32_t count = b->counts[(size_t)i * DIGITS + d];

				b->counts[(size_t)i * DIGITS + d] = sum;
				sum += count;
			}
		run_all(b, b->n_chunks, forks, threads, move_items);
		b->from = b->to;
		b->to = swap;
	}
}

/* --- Nodes ------------------------------------------------------------------------------------------------------- */

/* Find the division of items: after the last one with a 0 in the highest bit of the code that changes. */
static uint32_t find_split(const struct build *b, uint32_t first, uint32_t count, uint32_t depth)
{
	const uint64_t changes = b->from[first].code ^ b->from[first + count - 1].code;
	uint32_t lo = first, hi = first + count - 1, log2 = 32 - (uint32_t)__builtin_clz(count - 1);

	/* Halve by count if all codes are equal or little depth is left. */
	if (!changes || depth + log2 + 1 >= BVH_MAX_DEPTH)
		return first + count / 2;
	while (lo + 1 < hi) {
		const uint32_t middle = lo + (hi - lo) / 2;

		if (b->from[middle].code >> (63 - __builtin_clzll(changes)) & 1)
			hi = middle;
		else
			lo = middle;
	}
	return hi;
}

static void set_side(struct node2 *node, int side, box8 box, uint32_t child, uint32_t count)
{
	const vec4 lo = -box8_negative_lo(box), hi = box8_hi(box);

	for (int a = 0; a < 3; a++) {
		node->lo[side][a] = lo[a];
		node->hi[side][a] = hi[a];
	}
	node->child[side] = child;
	node->count[side] = count;
}

/*
 * Write the subtree over a range of items, starting at the part's next node. A subtree of at most leaf_max items
 * becomes a leaf if that is cheaper, unless it `must` be a node.
 * @return its cost, with areas not divided by the root's; *child and *count_out receive the parent's values
 */
static float emit(const struct build *b, struct part *part, uint32_t first, uint32_t count, uint32_t depth, int must,
                  box8 *box, uint32_t *child, uint32_t *count_out)
{
	const uint32_t at = part->first + part->used;
	box8 sides[2];
	float cost = 0, leaf;
	uint32_t split, ends[3];

	if (count == 1) {
		*box = b->sorted[first];
		*child = first;
		*count_out = 1;
		return box8_half_area(*box);
	}
	part->used++;
	split = find_split(b, first, count, depth);
	ends[0] = first, ends[1] = split, ends[2] = first + count;
	for (int side = 0; side < 2; side++) {
		uint32_t to, n;

		cost += emit(b, part, ends[side], ends[side + 1] - ends[side], depth + 1, 0, &sides[side], &to, &n);
		set_side(&b->nodes[at], side, sides[side], to, n);
	}
	*box = box8_join(sides[0], sides[1]);
	cost += BVH_COST_NODE * box8_half_area(*box);
	leaf = box8_half_area(*box) * (float)count;
	*child = at;
	*count_out = 0;
	if (count > b->leaf_max || must || cost < leaf)
		return cost;
	part->used = at - part->first;
	*child = first;
	*count_out = count;
	return leaf;
}

static void fill_part(void *arg, const void *task)
{
	struct build *b = arg;
	struct part *part = &b->parts[*(const uint32_t *)task];

	for (uint32_t i = part->first; i < part->first + part->count; i++) {
		const struct bvh_box *box = &b->boxes[b->from[i].item];

		b->order[i] = b->from[i].item;
		b->sorted[i] = box8_make((vec4){ -box->lo[0], -box->lo[1], -box->lo[2], 0 },
		                         (vec4){ box->hi[0], box->hi[1], box->hi[2], 0 });
	}
	emit(b, part, part->first, part->count, part->depth, part->count == b->n, &part->box, &part->child, &part->n_items);
}

/* Write the levels above the parts to `nodes`, from 0 on. For now, a side that is a part has the part's number as child
 * and the count IS_PART. */
static void lay_out(struct build *b, struct node2 *nodes, uint32_t *used, uint32_t first, uint32_t count,
                    uint32_t depth, uint32_t *child, uint32_t *count_out)
{
	const uint32_t at = *used;
	uint32_t ends[3] = { first, 0, first + count };

	if (count < 2 * GRAIN) {
		b->parts[b->n_parts] = (struct part){ .first = first, .count = count, .depth = depth };
		*child = b->n_parts++;
		*count_out = IS_PART;
		return;
	}
	(*used)++;
	ends[1] = find_split(b, first, count, depth);
	*child = at;
	*count_out = 0;
	for (int side = 0; side < 2; side++) {
		uint32_t to, n;

		lay_out(b, nodes, used, ends[side], ends[side + 1] - ends[side], depth + 1, &to, &n);
		nodes[at].child[side] = to;
		nodes[at].count[side] = n;
	}
}

/* Move a part's nodes to their final position. */
static void move_part(void *arg, const void *task)
{
	const struct build *b = arg;
	const struct part *part = &b->parts[*(const uint32_t *)task];

	for (uint32_t i = 0; i < part->used; i++) {
		struct node2 *node = &b->out[part->place + i];

		*node = b->nodes[part->first + i];
		for (int side = 0; side < 2; side++)
			if (!node->count[side])
				node->child[side] += part->place - part->first;
	}
}

/* Link the levels above to the parts, and set their boxes. */
static void close_top(const struct build *b, uint32_t n_top)
{
	for (uint32_t i = n_top; i-- > 0;)
		for (int side = 0; side < 2; side++) {
			struct node2 *node = &b->out[i];

			if (node->count[side] == IS_PART) {
				const struct part *part = &b->parts[node->child[side]];

				set_side(node, side, part->box, part->child, part->n_items);
			} else {
				const struct node2 *below = &b->out[node->child[side]];

				for (int a = 0; a < 3; a++) {
					node->lo[side][a] = fminf(below->lo[0][a], below->lo[1][a]);
					node->hi[side][a] = fmaxf(below->hi[0][a], below->hi[1][a]);
				}
			}
		}
}

/* Build over sorted items. @return number of nodes: first the levels above the parts, then all parts in the order of
 * their items */
static uint32_t build_nodes(struct build *b, struct forks *forks, unsigned threads)
{
	uint32_t n_top = 0, child, count, n;

	lay_out(b, b->out, &n_top, 0, b->n, 0, &child, &count);
	run_all(b, b->n_parts, forks, threads, fill_part);
	n = n_top;
	for (uint32_t p = 0; p < b->n_parts; p++) {
		struct part *part = &b->parts[p];

		part->place = n;
		if (!part->n_items)
			part->child += n - part->first;
		n += part->used;
	}
	run_all(b, b->n_parts, forks, threads, move_part);
	close_top(b, n_top);
	return n;
}

int bvh_build_linear(const struct bvh_input *in, struct tree *out)
{
	const uint32_t n = in->n;
	/* Each level divides parts of 2 * GRAIN items and more. */
	const uint32_t most_parts = BVH_MAX_DEPTH * (n / (2 * GRAIN) + 1) + 1;
	const unsigned threads = n < 2 * GRAIN ? 1 : in->threads;
	struct build b = { .boxes = in->boxes,
		           .n = n,
		           .leaf_max = in->leaf_max,
		           .out = out->nodes,
		           .order = out->order,
		           .chunk = 4 * GRAIN };
	struct forks forks = { 0 };
	int err = 0;

	if (n < 2)
		return bvh_build_sah(in, out);
	b.n_chunks = (n - 1) / b.chunk + 1;
	b.from = malloc(n * sizeof(*b.from));
	b.to = malloc(n * sizeof(*b.to));
	b.bounds = malloc(b.n_chunks * sizeof(*b.bounds));
	b.counts = malloc((size_t)b.n_chunks * DIGITS * sizeof(*b.counts));
	b.nodes = malloc(n * sizeof(*b.nodes));
	b.sorted = aligned_alloc(32, n * sizeof(*b.sorted));
	b.parts = aligned_alloc(32, (most_parts * sizeof(*b.parts) + 31) / 32 * 32);
	if (!b.sorted || !b.from || !b.to || !b.bounds || !b.counts || !b.nodes || !b.parts)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = forks_init(&forks, sizeof(uint32_t), most_parts > b.n_chunks ? most_parts : b.n_chunks);
	if (err)
		goto done;
	sort(&b, &forks, n < SORT_ALONE ? 1 : threads);
	out->n_nodes = build_nodes(&b, &forks, threads);
	out->n_order = n;
	forks_free(&forks);
done:
	free(b.from);
	free(b.to);
	free(b.bounds);
	free(b.counts);
	free(b.nodes);
	free(b.sorted);
	free(b.parts);
	return err;
}
