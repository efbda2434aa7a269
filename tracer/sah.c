/* The binned builder for any processor, and the choice between its two compilations: both give the same tree. */
#define SAH_BUILD sah_build_plain
#include "tracer/sah_build.h"

int sah_build_avx2(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                   uint32_t *n_nodes, uint32_t *order);

int bvh_build_sah(const struct bvh_box *boxes, uint32_t n, uint32_t leaf_max, unsigned threads, struct node2 *nodes,
                  uint32_t *n_nodes, uint32_t *order)
{
#ifdef __x86_64__
	if (__builtin_cpu_supports("avx2"))
		return sah_build_avx2(boxes, n, leaf_max, threads, nodes, n_nodes, order);
#endif
	return sah_build_plain(boxes, n, leaf_max, threads, nodes, n_nodes, order);
}
