/* Trees: every item is in exactly one leaf, boxes enclose their contents, depth is bounded; and meshes are
 * recognised across frames by content. */
#include "tests/check/random_scene.h"

#include "kernels/rays/compressed.h"
#include "tests/case.h"
#include "tracer/accel/builders.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/compress.h"
#include "tracer/accel/sah_build.h"

#define N 70000
#define CUT_MAX 20000 /* triangles for trees with spatial splits */

static struct bvh_box boxes[N];
static struct node2 nodes[N];
static struct node8 nodes8[N];
static struct node8c nodes8c[BVH_COMPRESSED_NODES(N, N)];
static struct triangle triangles[N], triangles8c[N]; /* only their indices matter here */
static uint32_t order[N], block_first[N], block_count[N];
static uint8_t seen[N];

static void check_item(uint32_t item, const float lo[3], const float hi[3])
{
	ck_assert_uint_eq(seen[item], 0);
	seen[item] = 1;
	for (int a = 0; a < 3; a++)
		ck_assert(boxes[item].lo[a] >= lo[a] && boxes[item].hi[a] <= hi[a]);
}

static void check_node2(uint32_t index, uint32_t depth)
{
	ck_assert_uint_lt(depth, BVH_MAX_DEPTH);
	for (int side = 0; side < 2; side++) {
		const struct node2 *node = &nodes[index];

		if (node->count[side] == 0 && node->child[side] == 0)
			continue;
		for (uint32_t k = 0; k < node->count[side]; k++)
			check_item(order[node->child[side] + k], node->lo[side], node->hi[side]);
		if (node->count[side] == 0)
			check_node2(node->child[side], depth + 1);
	}
}

static void check_node8(uint32_t index, uint32_t depth)
{
	ck_assert_uint_lt(depth, BVH_MAX_DEPTH);
	for (int lane = 0; lane < 8; lane++) {
		const struct node8 *node = &nodes8[index];
		const float lo[3] = { node->lo[0][lane], node->lo[1][lane], node->lo[2][lane] };
		const float hi[3] = { node->hi[0][lane], node->hi[1][lane], node->hi[2][lane] };

		if (node->count[lane] == 0 && node->child[lane] == 0)
			continue;
		if (node->count[lane] == 0) {
			check_node8(node->child[lane], depth + 1);
			continue;
		}
		ck_assert_uint_eq(node->count[lane], 1);
		ck_assert_uint_le(block_count[node->child[lane]], 8);
		for (uint32_t k = 0; k < block_count[node->child[lane]]; k++)
			check_item(order[block_first[node->child[lane]] + k], lo, hi);
	}
}

/* Boxes must enclose their contents, and may exceed them by at most two steps of their grid. @param below  receives
 * the node's own box */
static void check_node8c(uint32_t index, uint32_t depth, struct bvh_box *below)
{
	const struct node8c *node = &nodes8c[index];

	ck_assert_uint_lt(depth, NODE8C_MAX_DEPTH);
	bvh_box_clear(below);
	for (uint32_t slot = 0; slot < 8; slot++) {
		struct bvh_box box, content;
		uint32_t first, count;

		if (!node8c_box(node, slot, box.lo, box.hi))
			continue;
		count = node8c_child(node, slot, &first);
		ck_assert_uint_le(count, NODE8C_LEAF_MAX);
		bvh_box_clear(&content);
		if (count == 0)
			check_node8c(first, depth + 1, &content);
		for (uint32_t k = 0; k < count; k++) {
			check_item(triangles8c[first + k].primitive, box.lo, box.hi);
			bvh_box_join(&content, &boxes[triangles8c[first + k].primitive]);
		}
		for (uint32_t a = 0; a < 3; a++) {
			const float slack = 2 * node8c_step(node->exponents, a) + 1e-6f * fabsf(node->origin[a]);

			ck_assert(box.lo[a] <= content.lo[a] && box.hi[a] >= content.hi[a]);
			ck_assert(box.lo[a] >= content.lo[a] - slack && box.hi[a] <= content.hi[a] + slack);
		}
		bvh_box_join(below, &content);
	}
}

/* The builder is compiled more than once; all versions must make the same tree, with any number of threads. */
static void check_same_tree(uint32_t n, uint32_t n_nodes)
{
	static struct node2 plain[N];
	static uint32_t plain_order[N];
	const struct bvh_input in = { .boxes = boxes, .n = n, .leaf_max = 4, .room = n, .threads = 1 };
	struct tree tree = { .nodes = plain, .order = plain_order };

	ck_assert_int_eq(sah_build_plain(SAH_OBJECTS, &in, 32, &tree), 0);
	ck_assert_uint_eq(tree.n_order, n);
	ck_assert_uint_eq(tree.n_nodes, n_nodes);
	ck_assert_mem_eq(plain, nodes, n_nodes * sizeof(*nodes));
	ck_assert_mem_eq(plain_order, order, n * sizeof(*order));
}

static void check_same_linear(uint32_t n, uint32_t n_nodes)
{
	static struct node2 alone[N];
	static uint32_t alone_order[N];
	const struct bvh_input in = { .boxes = boxes, .n = n, .leaf_max = 4, .threads = 1 };
	struct tree tree = { .nodes = alone, .order = alone_order };

	ck_assert_int_eq(bvh_build_linear(&in, &tree), 0);
	ck_assert_uint_eq(tree.n_order, n);
	ck_assert_uint_eq(tree.n_nodes, n_nodes);
	ck_assert_mem_eq(alone, nodes, n_nodes * sizeof(*nodes));
	ck_assert_mem_eq(alone_order, order, n * sizeof(*order));
}

/* @return binary nodes for each compressed one */
static float check_trees(uint32_t n, int linear)
{
	const struct bvh_input in = { .boxes = boxes, .n = n, .leaf_max = 4, .threads = 3 };
	struct tree tree = { .nodes = nodes, .order = order };
	uint32_t n_nodes, n_nodes8, n_blocks;
	struct bvh_box whole;

	ck_assert_int_eq((linear ? bvh_build_linear : bvh_build_sah)(&in, &tree), 0);
	n_nodes = tree.n_nodes;
	(linear ? check_same_linear : check_same_tree)(n, n_nodes);
	ck_assert_uint_le(n_nodes, n > 1 ? n - 1 : 1);
	memset(seen, 0, sizeof(seen));
	check_node2(0, 0);
	for (uint32_t i = 0; i < n; i++)
		ck_assert_msg(seen[i], "item %u of %u is in no leaf", i, n);
	ck_assert_int_eq(bvh_collapse8(nodes, n_nodes, BVH_BLOCKS, nodes8, &n_nodes8, block_first, block_count, &n_blocks), 0);
	ck_assert_uint_le(n_nodes8, n_nodes);
	memset(seen, 0, sizeof(seen));
	check_node8(0, 0);
	for (uint32_t i = 0; i < n; i++)
		ck_assert_msg(seen[i], "item %u of %u is in no block", i, n);
	for (uint32_t i = 0; i < n; i++)
		triangles[i].primitive = order[i];
	ck_assert_int_eq(bvh_compress8(nodes, n_nodes, triangles, n, nodes8c, &n_nodes8, triangles8c), 0);
	ck_assert_uint_le(n_nodes8, BVH_COMPRESSED_NODES(n_nodes, n));
	memset(seen, 0, sizeof(seen));
	check_node8c(0, 0, &whole);
	for (uint32_t i = 0; i < n; i++)
		ck_assert_msg(seen[i], "item %u of %u is in no compressed node", i, n);
	return (float)n_nodes / (float)n_nodes8;
}

/* Leaves too large for a compressed node become nodes. */
static void check_large_leaves(uint32_t n, uint32_t leaf)
{
	const struct bvh_input in = { .boxes = boxes, .n = n, .leaf_max = leaf, .threads = 3 };
	struct tree tree = { .nodes = nodes, .order = order };
	uint32_t n_nodes, n_nodes8;
	struct bvh_box whole;

	ck_assert_int_eq(bvh_build_sah(&in, &tree), 0);
	n_nodes = tree.n_nodes;
	for (uint32_t i = 0; i < n; i++)
		triangles[i].primitive = order[i];
	ck_assert_int_eq(bvh_compress8(nodes, n_nodes, triangles, n, nodes8c, &n_nodes8, triangles8c), 0);
	ck_assert_uint_le(n_nodes8, BVH_COMPRESSED_NODES(n_nodes, n));
	memset(seen, 0, sizeof(seen));
	check_node8c(0, 0, &whole);
	for (uint32_t i = 0; i < n; i++)
		ck_assert_msg(seen[i], "item %u of %u is in no compressed node", i, n);
}

/* The same with spatial splits and as kd-trees, for any number of threads; leaves do not exceed the requested size. */
static void check_cut_trees(const struct triangle *triangles, uint32_t n, uint32_t room)
{
	static struct node2 nodes_first[4 * CUT_MAX + 1], nodes_other[4 * CUT_MAX + 1];
	static uint32_t order_first[4 * CUT_MAX + 1], order_other[4 * CUT_MAX + 1];

	for (int kd = 0; kd < 2; kd++) {
		struct bvh_input in = { .boxes = boxes, .triangles = triangles, .n = n, .leaf_max = 4, .room = room, .threads = 1 };
		struct tree first = { .nodes = nodes_first, .order = order_first },
			    other = { .nodes = nodes_other, .order = order_other };

		ck_assert_int_eq((kd ? bvh_build_kd : bvh_build_sbvh)(&in, &first), 0);
		in.threads = 3;
		ck_assert_int_eq((kd ? bvh_build_kd : bvh_build_sbvh)(&in, &other), 0);
		ck_assert_uint_eq(first.n_nodes, other.n_nodes);
		ck_assert_uint_eq(first.n_order, other.n_order);
		ck_assert_uint_le(first.n_order, room);
		ck_assert_mem_eq(nodes_first, nodes_other, first.n_nodes * sizeof(*nodes_first));
		ck_assert_mem_eq(order_first, order_other, first.n_order * sizeof(*order_first));
		memset(seen, 0, sizeof(seen));
		for (uint32_t i = 0; i < first.n_order; i++)
			seen[order_first[i]] = 1;
		for (uint32_t i = 0; i < n; i++)
			ck_assert_msg(seen[i], "item %u of %u is in no leaf", i, n);
		for (uint32_t i = 0; i < first.n_nodes; i++)
			for (int side = 0; side < 2; side++)
				ck_assert_uint_le(nodes_first[i].count[side], 4);
	}
}

static void set_box(uint32_t i, float x, float y, float z, float size)
{
	boxes[i] = (struct bvh_box){ { x - size, y - size, z - size }, { x + size, y + size, z + size } };
}

START_TEST(all_items_in_one_leaf)
{
	struct random_scene r = { .random = seed_of_run };
	const uint32_t counts[] = { 0, 1, 2, 3, 4, 5, 8, 9, 100, 8191, 8192, 20000, N };

	for (uint32_t i = 0; i < N; i++)
		set_box(i, between(&r, -1, 1), between(&r, -1, 1), between(&r, -9, 9), between(&r, 0, 0.1f));
	for (size_t k = 0; k < sizeof(counts) / sizeof(counts[0]); k++)
		check_trees(counts[k], _i);
	ck_assert_float_gt(check_trees(N, _i), 4); /* seven if all were full */
	for (uint32_t i = 0; i < N; i++) /* cannot be divided */
		set_box(i, 1, 2, 3, 0);
	for (uint32_t leaf = 5; leaf <= BVH_COMPRESSED_LEAF; leaf = 3 * leaf + 1)
		check_large_leaves(N, leaf);
}
END_TEST

START_TEST(strange_boxes_keep_the_depth)
{
	for (uint32_t i = 0; i < N; i++) /* all equal */
		set_box(i, 1, 2, 3, 0);
	check_trees(N, _i);
	for (uint32_t i = 0; i < N; i++) /* each farther than all before together */
		set_box(i, ldexpf(1, (int)(i % 120) - 60), 0, 0, 0);
	check_trees(N, _i);
	for (uint32_t i = 0; i < N; i++) /* infinite ones among small ones */
		set_box(i, (float)i, 0, 0, i % 10 ? 0.5f : 1e18f);
	check_trees(N, _i);
}
END_TEST

START_TEST(cut_space_loses_nothing)
{
	struct random_scene r = { .random = seed_of_run };
	const uint32_t counts[] = { 0, 1, 2, 5, 17, 300, CUT_MAX };
	static struct triangle triangles[CUT_MAX];

	for (uint32_t i = 0; i < CUT_MAX; i++) {
		for (int a = 0; a < 3; a++) {
			/* Some all in one place, some flat. */
			triangles[i].v0[a] = i % 11 ? between(&r, -9, 9) : 1;
			triangles[i].e1[a] = i % 11 ? between(&r, -2, 2) : 3;
			triangles[i].e2[a] = i % 13 == (uint32_t)a ? 0 : between(&r, -2, 2);
			boxes[i].lo[a] = triangles[i].v0[a] + fminf(0, fminf(triangles[i].e1[a], triangles[i].e2[a]));
			boxes[i].hi[a] = triangles[i].v0[a] + fmaxf(0, fmaxf(triangles[i].e1[a], triangles[i].e2[a]));
		}
	}
	for (size_t k = 0; k < sizeof(counts) / sizeof(counts[0]); k++)
		for (uint32_t share = 0; share < 4; share++) /* memory that is used up, or not */
			check_cut_trees(triangles, counts[k], counts[k] + 1 + counts[k] * share * share / 3);
}
END_TEST

static void build(struct random_scene *s, uint32_t n)
{
	ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances, n, &s->view, &s->spaces,
	                                   &s->n_spaces), 0);
}

START_TEST(meshes_are_kept_and_dropped)
{
	struct random_scene *s = random_scene_create(1);
	const size_t triangles = s->accel->n_triangles, n_nodes8c = s->accel->n_nodes8c;
	uint64_t generation = s->accel->generation;

	build(s, INSTANCES);
	ck_assert_uint_eq(s->accel->generation, generation);
	ck_assert_uint_eq(s->instances[0].node2_first, s->instances[3].node2_first); /* the same mesh */
	/* Only the last two meshes are used for many frames: the first is dropped, and they move up. */
	for (int frame = 0; frame < 40; frame++)
		ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances + 1, 2, &s->view, &s->spaces,
		                                   &s->n_spaces), 0);
	ck_assert_uint_lt(s->accel->n_triangles, triangles);
	ck_assert_uint_eq(s->accel->n_triangles8c, s->accel->n_triangles);
	ck_assert_uint_eq(s->instances[1].node8c_first, 0);
	ck_assert_uint_gt(s->accel->generation, generation);
	ck_assert_uint_eq(s->instances[1].triangle_first, 0);
	build(s, INSTANCES);
	ck_assert_uint_eq(s->accel->n_triangles, triangles);
	ck_assert_uint_eq(s->accel->n_nodes8c, n_nodes8c);
	/* An empty frame. */
	build(s, 0);
	ck_assert_uint_eq(s->view.tlas_count, 0);
	ck_assert_uint_eq(s->spaces[0].n_nodes, 0);
	random_scene_free(s);
}
END_TEST

/* Data that accel_pool reports as unchanged must be unchanged: meshes appear, move and disappear, and a copy is
 * updated as the tracer updates its device. */
START_TEST(copies_are_kept_up)
{
	struct random_scene *s = random_scene_create(3);
	char *copies[N_BLAS_PARTS] = { NULL };
	size_t copied = 0, all = 0;

	for (uint32_t frame = 0; frame < 200; frame++) {
		const uint32_t first = frame % 50 < 25, n = between(s, 0, 1) < 0.5f ? 1 : 3;

		s->meshes[frame % MESHES].hash[1] = frame; /* as if it had moved */
		ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances + first, n, &s->view, &s->spaces,
		                                   &s->n_spaces), 0);
		for (int part = 0; part < N_BLAS_PARTS; part++) {
			const struct accel_pool pool = accel_pool(s->accel, (enum blas_part)part);
			const size_t bytes = blas_item_bytes[part];

			ck_assert_uint_le(pool.same, pool.n);
			if (pool.same)
				ck_assert_mem_eq(copies[part], pool.items, pool.same * bytes);
			copies[part] = realloc(copies[part], pool.n * bytes + 1);
			memcpy(copies[part] + pool.same * bytes, (const char *)pool.items + pool.same * bytes, (pool.n - pool.same) * bytes);
			ck_assert_mem_eq(copies[part], pool.items, pool.n * bytes);
			copied += (pool.n - pool.same) * bytes;
			all += pool.n * bytes;
		}
		accel_copied(s->accel);
	}
	ck_assert_uint_lt(copied, all / 2);
	for (int part = 0; part < N_BLAS_PARTS; part++)
		free(copies[part]);
	random_scene_free(s);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("accel");

	choose_seed();
	tcase_set_timeout(tests, 60);
	tcase_add_loop_test(tests, all_items_in_one_leaf, 0, 2);
	tcase_add_loop_test(tests, strange_boxes_keep_the_depth, 0, 2);
	tcase_add_test(tests, cut_space_loses_nothing);
	tcase_add_test(tests, meshes_are_kept_and_dropped);
	tcase_add_test(tests, copies_are_kept_up);
	return run_case(tests, "accel");
}
