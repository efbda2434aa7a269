/* plain, plain_shadow: see kernels/frame/plain/plain.h. */
#include "kernels/frame/plain/plain_show.h"

/* s: arguments for packs and shade_item, with visibility once lights have been queried */
static inline void do_block(const struct plain_arguments *a, const struct shade_arguments *s, uint item)
{
	struct plain_empty empty = { SCENE_NONE };
	const int is_in_dome = a->dome.reach > 0;
	struct plain_kept kept;
	struct shown_row row;

	pack_keep_nothing(&kept.pack);
	kept.encoded.known = 0;
	for (uint k = 0; k < PLAIN_ROWS; k++) {
		const uint lanes = plain_load_row(a, s->n_slots, item, k, &row.at);
		struct pack_planes to;

		for (uint i = 0; i < PACK_SIZE * a->n_slots && !s->n_slots && row.at.base != SCENE_NONE; i++)
			if (!(lanes >> i % PACK_SIZE & 1))
				stage_no_ray(&a->rays[i / PACK_SIZE * a->n + row.at.base + i % PACK_SIZE]);
		if (row.at.y >= a->request.height || (s->n_slots && !row.at.dimmed && !is_in_dome))
			continue;
		to = pack_planes_of(&a->request, a->halves, a->floats, row.at.x, row.at.y);
		plain_show_row(a, s, &row, lanes, is_in_dome, &to, &kept, &empty);
	}
}

KERNEL_OF(float16) void plain(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, 0);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_block(&a, &s, (uint)get_global_id(0));
}

KERNEL_OF(float16) void plain_shadow(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_block(&a, &s, (uint)get_global_id(0));
}
