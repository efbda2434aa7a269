/*
 * program_packet: program for SHADE_PACKET consecutive fragments of the list per work item, for CPUs, material by
 * material (kernels/frame/pack/pack_program.h). Fragments that packs do not support are processed one by one; a
 * triangle with several fragments is set up once.
 *
 * plain_program: the same for a block of a plain frame's pixels (kernels/frame/plain/plain.h). Frames without programs
 * compile neither kernel.
 */
#include "kernels/frame/pack/pack_program.h"
#include "kernels/frame/plain/plain_row.h"

struct program_kept {
	struct setup_kept one;
	struct pack_kept pack;
	struct pack_runs runs;
};

static inline void keep_nothing(struct program_kept *kept)
{
	kept->one.instance = SCENE_NONE;
	pack_keep_nothing(&kept->pack);
}

/* --- Lists ------------------------------------------------------------------------------------------------------- */

/* Find the fragments whose colour depends on programs. */
static inline void find_left(const struct shade_arguments *a, uint first, struct pack_left *left)
{
	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, a->n - first); i++) {
		__global const struct geometry *g = &a->tables.geometries[a->fragments[first + i].instance];
		__global const struct scene_material *m = &a->tables.materials[g->material];
		const uint flags = a->shaded[first + i].flags;

		if (!stage_is_by_program(a, m, g->flags) || !(flags & SHADED_THERE) || flags & SHADED_STENCIL ||
		    (a->n_slots && !stage_dimmed(a->visibility, a->n_slots, a->n, first + i)))
			continue;
		left->material[i] = g->material;
		left->all |= (ulong)1 << i;
		if (pack_knows_geometry(g) && pack_knows_program(a, m))
			left->packed |= (ulong)1 << i;
	}
}

static inline void run_next(const struct shade_arguments *a, struct pack_left *left, struct program_kept *kept)
{
	uint item[PACK_SIZE], lanes = pack_next(left, item), alone = lanes ? lanes : 1;
	struct pack_list list;

	for (uint lane = 0; lane < PACK_SIZE && lanes; lane++)
		pack_take(a->fragments, a->pixels, item[lane], lane, &list);
	if (lanes)
		alone = lanes & ~pack_program(a, &list, lanes, 0, &kept->pack, &kept->runs);
	for (; alone; alone &= alone - 1)
		program_item(a, item[popcount((alone & -alone) - 1)], 1, &kept->one);
}

KERNEL_OF(float16) void program_packet(KERNEL_ARGUMENTS(shade))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct program_kept kept;
	struct pack_left left;

	if (first >= n)
		return;
	keep_nothing(&kept);
	find_left(&a, first, &left);
	while (left.all)
		run_next(&a, &left, &kept);
}

/* --- Plain frames ------------------------------------------------------------------------------------------------ */

/* A fragment that packs do not support: shaded without its program, then by it. */
static inline void run_alone(const struct plain_arguments *a, const struct shade_arguments *s,
                             const struct plain_row *row, uint lane, struct program_kept *kept)
{
	const uint item = row->base + lane;

	if (!s->n_slots) {
		a->fragments[item] = plain_fragment(a, row->x + lane, row->y);
		a->pixels[item] = row->list.pixel[lane];
	}
	shade_item(s, item, 0, &kept->one);
	program_item(s, item, 0, &kept->one);
}

static inline void run_row(const struct plain_arguments *a, const struct shade_arguments *s,
                           const struct plain_row *row, uint lanes, struct program_kept *kept)
{
	while (lanes) {
		const uint bit = lanes & -lanes;
		__global const struct geometry *g = &s->tables.geometries[row->list.instance[popcount(bit - 1)]];
		__global const struct scene_material *m = &s->tables.materials[g->material];
		uint material, same = pack_same_kind(&s->tables, &row->list, lanes, &material), done = 0;

		same = same & bit ? same : 0;
		if (stage_is_by_program(s, m, g->flags)) {
			if (same && plain_knows(s, m))
				done = pack_program(s, &row->list, same, 1, &kept->pack, &kept->runs);
			if (!(done & bit))
				run_alone(a, s, row, popcount(bit - 1), kept);
		} else {
			done = same;
		}
		lanes &= ~(done | bit);
	}
}

KERNEL_OF(float16) void plain_program(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);
	const uint item = (uint)get_global_id(0);
	struct program_kept kept;
	struct plain_row row;

	if (item >= plain_blocks(width, request.height))
		return;
	keep_nothing(&kept);
	for (uint k = 0; k < PLAIN_ROWS; k++) {
		const uint lanes = plain_load_row(&a, n_slots, item, k, &row);

		run_row(&a, &s, &row, n_slots ? row.dimmed : lanes, &kept);
	}
}
