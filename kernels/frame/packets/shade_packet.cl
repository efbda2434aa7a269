/*
 * shade_packet: shade for SHADE_PACKET consecutive fragments of the list per work item, for CPUs: material by material,
 * sixteen at a time in vectors (kernels/frame/pack/pack_shade.h). The list is ordered by pixel, with all fragments of a
 * pixel together, so neighbours in a pack are mostly neighbours on the same surface. Fragments that packs do not
 * support are shaded one by one; a triangle with several fragments is set up once. kernels/README.md has the figures.
 */
#include "kernels/frame/pack/pack_shade.h"

/* Kept from one fragment of a launch to the next. */
struct shade_kept {
	struct setup_kept one[SHADE_TRIANGLES];
	struct pack_kept pack;
};

/* Find the fragments to shade. */
static inline void find_left(const struct shade_arguments *a, uint first, struct pack_left *left)
{
	uint last = SCENE_NONE;
	int known = 0;

	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, a->n - first); i++) {
		__global const struct geometry *g = &a->tables.geometries[a->fragments[first + i].instance];

		if (a->n_slots && !(a->shaded[first + i].flags & SHADED_THERE &&
		                    stage_dimmed(a->visibility, a->n_slots, a->n, first + i)))
			continue;
		if (g->material != last)
			known = pack_is_plain(a, &a->tables.materials[g->material]);
		last = left->material[i] = g->material;
		left->all |= (ulong)1 << i;
		if (known && pack_knows_geometry(g))
			left->packed |= (ulong)1 << i;
	}
}

static inline void shade_alone(const struct shade_arguments *a, uint i, struct shade_kept *kept)
{
	shade_item(a, i, 1, &kept->one[a->fragments[i].primitive % SHADE_TRIANGLES]);
}

static inline void shade_next(const struct shade_arguments *a, struct pack_left *left, struct shade_kept *kept)
{
	uint item[PACK_SIZE], lanes = pack_next(left, item), alone;
	struct pack_list list;

	if (!lanes) {
		shade_alone(a, item[0], kept);
		return;
	}
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		pack_take(a->fragments, a->pixels, item[lane], lane, &list);
	for (alone = lanes & ~pack_shade(a, &list, lanes, &kept->pack); alone; alone &= alone - 1)
		shade_alone(a, item[popcount((alone & -alone) - 1)], kept);
}

KERNEL_OF(float16) void shade_packet(KERNEL_ARGUMENTS(shade))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct shade_kept kept;
	struct pack_left left;

	if (first >= n)
		return;
	for (uint32_t i = 0u; i < SHADE_TRIANGLES; i++)
		kept.one[i].instance = SCENE_NONE;
	pack_keep_nothing(&kept.pack);
	find_left(&a, first, &left);
	while (left.all)
		shade_next(&a, &left, &kept);
}
