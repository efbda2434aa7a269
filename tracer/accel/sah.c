/* The builders by surface area for any processor, and the choice between their two compilations: both give the same tree. */
#define SAH_BUILD sah_build_plain
#include "tracer/accel/sah_build.h"

int sah_build_avx2(enum bvh_splits splits, const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, uint32_t most_bins,
                   unsigned threads, uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order);

static int sah_build(enum bvh_splits splits, const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, uint32_t most_bins,
                     unsigned threads, uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order)
{
#ifdef __x86_64__
	if (__builtin_cpu_supports("avx2"))
		return sah_build_avx2(splits, boxes, triangles, n, leaf_max, most_bins, threads, room, nodes, n_nodes, order, n_order);
#endif
	return sah_build_plain(splits, boxes, triangles, n, leaf_max, most_bins, threads, room, nodes, n_nodes, order, n_order);
}

int bvh_build_sah(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                  uint32_t *n_nodes, uint32_t *order)
{
	uint32_t n_order;

	return sah_build(BVH_OBJECTS, boxes, NULL, n, leaf_max, MAX_BINS, threads, n, nodes, n_nodes, order, &n_order);
}

/*
 * Where the topmost planes fall by chance decides about a tenth of a tree's cost (the planes between bins are few there). The
 * binned builder is quick enough to ask it which number of bins suits the mesh.
 */
static int choose_bins(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                       uint32_t *order, uint32_t *best)
{
	static const uint32_t choices[] = { 16, 24, MAX_BINS };
	double least = INFINITY;
	int err = 0;

	for (size_t i = 0; i < sizeof(choices) / sizeof(choices[0]) && !err; i++) {
		uint32_t n_nodes, n_order;
		double cost;

		err = sah_build(BVH_OBJECTS, boxes, NULL, n, leaf_max, choices[i], threads, n, nodes, &n_nodes, order, &n_order);
		if (err)
			return err;
		cost = bvh_cost(nodes, n_nodes);
		if (cost < least) {
			least = cost;
			*best = choices[i];
		}
	}
	return err;
}

int bvh_build_sbvh(const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, unsigned threads,
                   uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order)
{
	uint32_t most_bins = MAX_BINS;
	int err = choose_bins(boxes, n, leaf_max, threads, nodes, order, &most_bins);

	return err ? err : sah_build(BVH_SPATIAL, boxes, triangles, n, leaf_max, most_bins, threads, room < n ? n : room, nodes, n_nodes, order,
	                             n_order);
}

int bvh_build_kd(const struct bvh_box *boxes, const struct triangle *triangles, uint32_t n, uint32_t leaf_max, unsigned threads,
                 uint32_t room, struct node2 *nodes, uint32_t *n_nodes, uint32_t *order, uint32_t *n_order)
{
	return sah_build(BVH_PLANES, boxes, triangles, n, leaf_max, MAX_BINS, threads, room < n ? n : room, nodes, n_nodes, order,
	                 n_order);
}
