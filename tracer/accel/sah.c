/* The surface area heuristic builders compiled for any processor, and the choice between both compilations
 * (sah_build.h). */
#define SAH_BUILD sah_build_plain
#include "tracer/accel/sah_build.inc"

static int build(enum sah_splits splits, const struct bvh_input *in, uint32_t most_bins, struct tree *out)
{
#ifdef __x86_64__
	if (__builtin_cpu_supports("avx2"))
		return sah_build_avx2(splits, in, most_bins, out);
#endif
	return sah_build_plain(splits, in, most_bins, out);
}

static int build_of_items(const struct bvh_input *in, uint32_t most_bins, struct tree *out)
{
	struct bvh_input items = *in;

	items.triangles = NULL;
	items.room = in->n;
	return build(SAH_OBJECTS, &items, most_bins, out);
}

int bvh_build_sah(const struct bvh_input *in, struct tree *out)
{
	return build_of_items(in, SAH_MAX_BINS, out);
}

/*
 * The topmost planes are a matter of chance, as there are few candidates between bins, and they make a difference of
 * about a tenth of a tree's cost. The binned builder is fast enough to try which number of bins suits the mesh.
 */
static int choose_bins(const struct bvh_input *in, struct tree *scratch, uint32_t *best)
{
	static const uint32_t choices[] = { 16, 24, SAH_MAX_BINS };
	double least = INFINITY;

	for (size_t i = 0; i < sizeof(choices) / sizeof(choices[0]); i++) {
		int err = build_of_items(in, choices[i], scratch);
		double cost;

		if (err)
			return err;
		cost = bvh_cost(scratch->nodes, scratch->n_nodes);
		if (cost < least) {
			least = cost;
			*best = choices[i];
		}
	}
	return 0;
}

int bvh_build_sbvh(const struct bvh_input *in, struct tree *out)
{
	uint32_t most_bins = SAH_MAX_BINS;
	int err = choose_bins(in, out, &most_bins);

	return err ? err : build(SAH_SPATIAL, in, most_bins, out);
}

int bvh_build_kd(const struct bvh_input *in, struct tree *out)
{
	return build(SAH_PLANES, in, SAH_MAX_BINS, out);
}
