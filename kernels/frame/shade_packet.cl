/*
 * shade_packet: shade with SHADE_PACKET consecutive fragments of the list a work item, for CPUs: sixteen at a time in vectors, material by
 * material (kernels/frame/pack.h). What that does not know is shaded one by one. Neighbours mostly lie in the same triangle: it is set up
 * once. kernels/README.md has the figures.
 */
#include "kernels/frame/pack.h"

/* What the fragments of a launch leave for the next ones. */
struct shade_kept {
	struct setup_kept one[SHADE_TRIANGLES];
	struct pack_kept pack;
};

/* A bit for each of sixteen fragments that is to be shaded. */
static inline uint to_shade(const struct shade_arguments *a, uint first)
{
	uint lanes = 0;

	for (uint i = first; i < min(first + PACK_SIZE, a->n); i++)
		if (!a->n_slots || (a->shaded[i].flags & SHADED_THERE && stage_dimmed(a->visibility, a->n_slots, a->n, i)))
			lanes |= 1u << (i - first);
	return lanes;
}

static inline void shade_sixteen(const struct shade_arguments *a, uint first, struct shade_kept *kept)
{
	struct pack_list list;
	uint material, lanes = to_shade(a, first);

	pack_list(a->fragments, a->pixels, first, a->n, &list);
	while (lanes) {
		const uint bit = lanes & -lanes, same = pack_same_kind(&a->tables, &list, lanes, &material);
		uint done = 0;

		if (same & bit && pack_is_plain(a, &a->tables.materials[material]))
			done = pack_shade(a, &list, first, same, &kept->pack);
		if (!(done & bit)) {
			const uint i = first + popcount(bit - 1);

			shade_item(a, i, 1, &kept->one[a->fragments[i].primitive % SHADE_TRIANGLES]);
			done |= bit;
		}
		lanes &= ~done;
	}
}

KERNEL_OF(float16) void shade_packet(KERNEL_ARGUMENTS(shade))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct shade_kept kept;

	for (uint32_t i = 0u; i < SHADE_TRIANGLES; i++)
		kept.one[i].instance = kept.pack.lit[i].instance = SCENE_NONE;
	for (uint32_t i = 0u; i < PACK_CUTS; i++)
		kept.pack.cuts[i].instance = SCENE_NONE;
	for (uint32_t i = first; i < first + SHADE_PACKET && i < n; i += PACK_SIZE)
		shade_sixteen(&a, i, &kept);
}
