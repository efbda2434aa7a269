#include "tracer/accel/compress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/rays/compressed.h"
#include "tracer/accel/bvh.h"

/* The smallest exponent of a normal float. Boxes are bounded (soup.h), so a grid for them always exists. */
#define LEAST_EXPONENT 1u

/* Is this lane of a node8 in use? */
static int lane_is_used(const struct node8 *node, int lane)
{
	return node->lo[0][lane] <= node->hi[0][lane];
}

/*
 * Choose a slot for each lane. Repeatedly take the best pair of all remaining lanes and slots: the one where the lane's
 * centre lies farthest along the slot's diagonal. -1: the lane is empty.
 */
static void choose_slots(const struct node8 *node, int slot_of[8])
{
	float middle[8][3], mean[3] = { 0, 0, 0 };
	int n = 0, taken = 0;

	for (int lane = 0; lane < 8; lane++) {
		slot_of[lane] = -1;
		if (!lane_is_used(node, lane))
			continue;
		n++;
		for (int a = 0; a < 3; a++) {
			middle[lane][a] = 0.5f * (node->lo[a][lane] + node->hi[a][lane]);
			mean[a] += middle[lane][a];
		}
	}
	for (int left = n; left > 0; left--) {
		int best_lane = -1, best_slot = 0;
		float best = 0;

		for (int lane = 0; lane < 8; lane++) {
			if (!lane_is_used(node, lane) || slot_of[lane] >= 0)
				continue;
			for (int slot = 0; slot < 8; slot++) {
				float fit = 0;

				if (taken >> slot & 1)
					continue;
				for (int a = 0; a < 3; a++) {
					const float off = middle[lane][a] - mean[a] / (float)n;

					fit += slot >> a & 1 ? off : -off;
				}
				if (best_lane < 0 || fit > best) {
					best = fit;
					best_lane = lane;
					best_slot = slot;
				}
			}
		}
		slot_of[best_lane] = best_slot;
		taken |= 1 << best_slot;
	}
}

/* Find the two bytes around a lane's box along an axis. @return 0: the grid's steps are too small */
static int quantise(float origin, float step, float lo, float hi, uint32_t *byte_lo, uint32_t *byte_hi)
{
	const float from = floorf((lo - origin) / step), to = ceilf((hi - origin) / step);

	if (to > 255)
		return 0;
	*byte_lo = from > 0 ? (uint32_t)from : 0;
	*byte_hi = to > 0 ? (uint32_t)to : 0;
	/* Correct for rounding: kernels compute planes with node8c_plane. */
	while (*byte_lo && node8c_plane(origin, step, *byte_lo) > lo)
		--*byte_lo;
	while (*byte_hi < 256 && node8c_plane(origin, step, *byte_hi) < hi)
		++*byte_hi;
	return *byte_hi < 256;
}

static void set_byte(uint32_t words[2], int slot, uint32_t byte)
{
	words[slot >> 2] = (words[slot >> 2] & ~(255u << 8 * (slot & 3))) | byte << 8 * (slot & 3);
}

/* Quantise boxes to a grid along one axis. @return 0: its steps are too small */
static int quantise_lanes(const struct node8 *in, int axis, const int slot_of[8], uint32_t exponent, struct node8c *out)
{
	for (int lane = 0; lane < 8; lane++) {
		uint32_t lo, hi;

		if (slot_of[lane] < 0)
			continue;
		if (!quantise(out->origin[axis], M_FLOAT(exponent << 23), in->lo[axis][lane], in->hi[axis][lane], &lo, &hi))
			return 0;
		set_byte(out->lo[axis], slot_of[lane], lo);
		set_byte(out->hi[axis], slot_of[lane], hi);
	}
	return 1;
}

/* Quantise boxes to the finest grid that contains them all. */
static void quantise_axis(const struct node8 *in, int axis, const int slot_of[8], struct node8c *out)
{
	float lo = BVH_EMPTY_LO, hi = BVH_EMPTY_HI;
	uint32_t exponent = LEAST_EXPONENT;

	for (int lane = 0; lane < 8; lane++)
		if (slot_of[lane] >= 0) {
			lo = fminf(lo, in->lo[axis][lane]);
			hi = fmaxf(hi, in->hi[axis][lane]);
		}
	out->origin[axis] = lo <= hi ? lo : 0;
	if (lo < hi && M_BITS((hi - lo) / 255) >> 23 > exponent)
		exponent = M_BITS((hi - lo) / 255) >> 23;
	while (!quantise_lanes(in, axis, slot_of, exponent, out))
		exponent++;
	out->exponents |= exponent << 8 * axis;
}

/* --- Choosing nodes ---------------------------------------------------------------------------------------------- */

/*
 * Lowest cost of a subtree as at most n children of one node, and how to reach it (Ylitie, Karras and Laine 2017,
 * section 3.1). left[n] of the children go to the left side; 0: n - 1 children cost the same. left[1] is for the eight
 * children of a separate node.
 */
struct plan {
	float cost[8]; /* [1..7] */
	uint8_t left[9];
};

static float side_area(const struct node2 *node, int side)
{
	const float x = node->hi[side][0] - node->lo[side][0], y = node->hi[side][1] - node->lo[side][1];
	const float z = node->hi[side][2] - node->lo[side][2];

	return x < 0 ? 0 : x * y + y * z + z * x;
}

/* The cost of one side of a node as at most n children. */
static float side_cost(const struct node2 *node, int side, const struct plan *plans, uint32_t n)
{
	return node->count[side] ? side_area(node, side) * (float)node->count[side] : plans[node->child[side]].cost[n];
}

/* Find the best way to share n children between the sides of a node. @return its cost */
static float share(const struct node2 *node, const struct plan *plans, uint32_t n, uint8_t *left)
{
	float best = INFINITY;

	for (uint32_t k = 1; k < n; k++) {
		const float cost = side_cost(node, 0, plans, k < 7 ? k : 7) + side_cost(node, 1, plans, n - k < 7 ? n - k : 7);

		if (cost < best || k == 1) {
			best = cost;
			*left = (uint8_t)k;
		}
	}
	return best;
}

/* area: area of the node's box, as from side_area. */
static void plan_node(const struct node2 *node, const struct plan *plans, float area, struct plan *out)
{
	out->cost[1] = share(node, plans, 8, &out->left[1]) + BVH_COST_NODE * area;
	for (uint32_t n = 2; n < 8; n++) {
		out->cost[n] = share(node, plans, n, &out->left[n]);
		if (out->cost[n - 1] < out->cost[n]) {
			out->cost[n] = out->cost[n - 1];
			out->left[n] = 0;
		}
	}
}

/* --- Nodes ------------------------------------------------------------------------------------------------------- */

/* Source of a compressed node: a binary node, or a box with too many items for a leaf. */
struct source {
	uint32_t first, count; /* count 0: a binary node */
	float lo[3], hi[3];
};

/* The tree that is being written. */
struct compression {
	const struct node2 *nodes2;
	const struct plan *plans;         /* [nodes2] */
	const struct triangle *triangles; /* in leaf order of the binary tree */
	struct node8c *nodes;
	struct triangle *out;
	struct source *from; /* [nodes] */
	uint32_t n_nodes, n_out;
};

/* Append one side of a binary node, as at most n children, to the lanes of a node8. */
static void add_lanes(const struct compression *c, const struct node2 *node, int side, uint32_t n, struct node8 *out,
                      uint32_t *lane)
{
	const struct plan *plan = &c->plans[node->child[side]];

	if (node->count[side] == 0 && node->child[side] == 0)
		return; /* an empty side */
	while (node->count[side] == 0 && n > 1 && plan->left[n] == 0)
		n--;
	if (node->count[side] == 0 && n > 1) {
		add_lanes(c, &c->nodes2[node->child[side]], 0, plan->left[n], out, lane);
		add_lanes(c, &c->nodes2[node->child[side]], 1, n - plan->left[n], out, lane);
		return;
	}
	for (int a = 0; a < 3; a++) {
		out->lo[a][*lane] = node->lo[side][a];
		out->hi[a][*lane] = node->hi[side][a];
	}
	out->child[*lane] = node->child[side];
	out->count[(*lane)++] = node->count[side];
}

/* Collapse a binary node and the nodes opened below it into a node8. */
static struct node8 collapse(const struct compression *c, uint32_t index)
{
	const uint32_t left = c->plans[index].left[1];
	struct node8 node;
	uint32_t lane = 0;

	memset(&node, 0, sizeof(node));
	for (int a = 0; a < 3; a++)
		for (int i = 0; i < 8; i++) {
			node.lo[a][i] = BVH_EMPTY_LO;
			node.hi[a][i] = BVH_EMPTY_HI;
		}
	add_lanes(c, &c->nodes2[index], 0, left < 7 ? left : 7, &node, &lane);
	add_lanes(c, &c->nodes2[index], 1, 8 - left < 7 ? 8 - left : 7, &node, &lane);
	return node;
}

/* Make a node8 of many items: eight leaves, or as many as needed, all with the same box. */
static struct node8 split_items(const struct source *items)
{
	const uint32_t n = items->count < 8 * NODE8C_LEAF_MAX ? (items->count + NODE8C_LEAF_MAX - 1) / NODE8C_LEAF_MAX : 8;
	struct node8 node;

	memset(&node, 0, sizeof(node));
	for (uint32_t lane = 0; lane < 8; lane++) {
		for (int a = 0; a < 3; a++) {
			node.lo[a][lane] = lane < n ? items->lo[a] : BVH_EMPTY_LO;
			node.hi[a][lane] = lane < n ? items->hi[a] : BVH_EMPTY_HI;
		}
		if (lane >= n)
			continue;
		node.child[lane] = items->first + (uint32_t)((uint64_t)items->count * lane / n);
		node.count[lane] = items->first + (uint32_t)((uint64_t)items->count * (lane + 1) / n) - node.child[lane];
	}
	return node;
}

/* Queue a lane that becomes a separate node. */
static void add_node(struct compression *c, const struct node8 *in, int lane)
{
	struct source *source = &c->from[c->n_nodes++];

	source->first = in->child[lane];
	source->count = in->count[lane];
	for (int a = 0; a < 3; a++) {
		source->lo[a] = in->lo[a][lane];
		source->hi[a] = in->hi[a][lane];
	}
}

static void compress_node(struct compression *c, const struct node8 *in, struct node8c *out)
{
	int slot_of[8], lane_of[8];

	memset(out, 0, sizeof(*out));
	memset(out->lo, 0xff, sizeof(out->lo));
	memset(lane_of, -1, sizeof(lane_of));
	choose_slots(in, slot_of);
	for (int lane = 0; lane < 8; lane++)
		if (slot_of[lane] >= 0)
			lane_of[slot_of[lane]] = lane;
	for (int axis = 0; axis < 3; axis++)
		quantise_axis(in, axis, slot_of, out);
	out->child_first = c->n_nodes;
	out->triangle_first = c->n_out;
	for (int slot = 0; slot < 8; slot++) {
		const int lane = lane_of[slot];
		const uint32_t count = lane < 0 ? 0 : in->count[lane];

		if (lane < 0)
			continue;
		if (count == 0 || count > NODE8C_LEAF_MAX) {
			out->exponents |= 1u << (24 + slot);
			add_node(c, in, lane);
			continue;
		}
		set_byte(out->meta, slot, NODE8C_LEAF | (count - 1) << 5 | (c->n_out - out->triangle_first));
		for (uint32_t i = 0; i < count; i++)
			c->out[c->n_out++] = c->triangles[in->child[lane] + i];
	}
}

int bvh_compress8(const struct node2 *nodes2, uint32_t n_nodes2, const struct triangle *triangles, uint32_t n_items,
                  struct node8c *nodes, uint32_t *n_nodes, struct triangle *out)
{
	struct plan *plans = calloc(n_nodes2, sizeof(*plans));
	struct compression c = { nodes2, plans, triangles, nodes, out,
		                 malloc(BVH_COMPRESSED_NODES(n_nodes2, n_items) * sizeof(*c.from)), 1, 0 };
	int err = 0;

	if (!plans || !c.from) {
		err = err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
		goto done;
	}
	/* Children come after their parents. */
	for (uint32_t i = n_nodes2; i-- > 0;) {
		struct node2 around = nodes2[i];

		for (int a = 0; a < 3; a++) {
			around.lo[0][a] = fminf(around.lo[0][a], around.lo[1][a]);
			around.hi[0][a] = fmaxf(around.hi[0][a], around.hi[1][a]);
		}
		plan_node(&nodes2[i], plans, side_area(&around, 0), &plans[i]);
	}
	c.from[0] = (struct source){ 0 };
	for (uint32_t i = 0; i < c.n_nodes; i++) {
		const struct node8 rows = c.from[i].count ? split_items(&c.from[i]) : collapse(&c, c.from[i].first);

		compress_node(&c, &rows, &nodes[i]);
	}
	*n_nodes = c.n_nodes;
done:
	free(plans);
	free(c.from);
	return err;
}
