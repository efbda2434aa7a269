/*
 * camera_packet: one 32 x 32 tile per work item (kernels/camera/tile_walk.h). This file stores the tile's fragments.
 * See kernels/camera/camera.h.
 */
#include "kernels/camera/tile_walk.h"

static inline void store_pixel(const struct tile *t, int x, int y, __global uint *counts)
{
	const struct camera_pack *p = &t->packs[y / BLOCK][x / BLOCK];
	const size_t pixel = place_of(t, x, y);
	const uint lane = y % BLOCK * BLOCK + x % BLOCK;
	struct fragment f;

	if (t->mode == CAMERA_COLUMN) {
		counts[pixel] = (uint)LANE_INT(p->counts, lane);
		return;
	}
	f.order = (uint)LANE_INT(p->order, lane);
	f.instance = (uint)LANE_INT(p->instance, lane);
	f.primitive = (uint)LANE_INT(p->primitive, lane);
	f.b1 = LANE_FLOAT(p->b1, lane);
	f.b2 = LANE_FLOAT(p->b2, lane);
	f.depth = fmin(LANE_FLOAT(p->depth, lane), 1.0f);
	t->fragments[pixel] = f;
	counts[pixel] = f.order != SCENE_NONE;
}

/* From each row of a block, four numbers per row: the first two of a and of b alternating, then the last two; halves of
 * a and of b. */
#define STORE_LOW(a, b) \
	(packu)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc, b.sc, a.sd, b.sd)
#define STORE_HIGH(a, b) \
	(packu)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se, b.se, a.sf, b.sf)
#define STORE_FIRST(a, b) (packu)(a.s01, b.s01, a.s45, b.s45, a.s89, b.s89, a.scd, b.scd)
#define STORE_LAST(a, b) (packu)(a.s23, b.s23, a.s67, b.s67, a.sab, b.sab, a.sef, b.sef)
#define STORE_FIRST_LAST(a, b) (packu)(a.s01, b.s23, a.s45, b.s67, a.s89, b.sab, a.scd, b.sef)
#define STORE_LAST_FIRST(a, b) (packu)(a.s23, b.s01, a.s67, b.s45, a.sab, b.s89, a.sef, b.scd)

/* A block's fragments, six numbers each: for each row, its quarter of all six vectors, one after the other. */
WIDE_VECTORS static inline void lay_out(const struct camera_pack *p, packu *out)
{
	const packu b1 = as_uint16(p->b1), b2 = as_uint16(p->b2), depth = as_uint16(pack_min(p->depth, (packf)(1)));
	const packu ids01 = STORE_LOW(p->order, p->instance), ids23 = STORE_HIGH(p->order, p->instance);
	const packu first01 = STORE_LOW(p->primitive, b1), first23 = STORE_HIGH(p->primitive, b1);
	const packu last01 = STORE_LOW(b2, depth), last23 = STORE_HIGH(b2, depth);

	out[0] = STORE_FIRST(ids01, first01);
	out[1] = STORE_FIRST_LAST(last01, ids01);
	out[2] = STORE_LAST(first01, last01);
	out[3] = STORE_FIRST(ids23, first23);
	out[4] = STORE_FIRST_LAST(last23, ids23);
	out[5] = STORE_LAST(first23, last23);
}

static inline void store_pack(packu value, __global uint *to, int aligned)
{
	if (aligned)
		*(__global packu *)to = value;
	else
		vstore16(value, 0, to);
}

/* Quarter i of four vectors goes to row i. */
WIDE_VECTORS static inline void store_rows(packu a, packu b, packu c, packu d, __global uint *to, size_t stride,
                                           int aligned)
{
	packu row[BLOCK];

	tile_quarters(a, b, c, d, row);
	for (int i = 0; i < BLOCK; i++)
		store_pack(row[i], to + i * stride, aligned);
}

/* Two adjacent blocks whose pixels are all stored: three times sixteen numbers per row. */
WIDE_VECTORS static inline void store_blocks(const struct tile *t, int x, int y, __global uint *counts)
{
	const size_t pixel = place_of(t, BLOCK * x, BLOCK * y);
	__global uint *fragments = (__global uint *)(t->fragments + pixel);
	const int aligned = ((pixel | t->width) & 7) == 0;
	packu left[6], right[6], count[2];

	lay_out(&t->packs[y][x], left);
	lay_out(&t->packs[y][x + 1], right);
	store_rows(left[0], left[1], left[2], left[3], fragments, 6 * t->width, aligned);
	store_rows(left[4], left[5], right[0], right[1], fragments + 16, 6 * t->width, aligned);
	store_rows(right[2], right[3], right[4], right[5], fragments + 32, 6 * t->width, aligned);
	for (int i = 0; i < 2; i++)
		count[i] = select((packu)(0), (packu)(1), t->packs[y][x + i].order != SCENE_NONE);
	for (int row = 0; row < BLOCK; row++) {
		const uint8 both = (uint8)(((const uint4 *)&count[0])[row], ((const uint4 *)&count[1])[row]);
		__global uint *to = counts + pixel + (size_t)row * t->width;

		if (aligned)
			*(__global uint8 *)to = both;
		else
			vstore8(both, 0, to);
	}
}

/* Store the tile's pixels that lie in the rectangle. */
static inline void store_tile(const struct tile *t, __global uint *counts)
{
	const struct camera_rectangle o = t->open;

	for (int y = o.y0 & -BLOCK; y < o.y1; y += BLOCK)
		for (int x = o.x0 & -(2 * BLOCK); x < o.x1; x += 2 * BLOCK)
			if (t->mode != CAMERA_COLUMN && x >= o.x0 && y >= o.y0 && x + 2 * BLOCK <= o.x1 && y + BLOCK <= o.y1)
				store_blocks(t, x / BLOCK, y / BLOCK, counts);
			else
				for (int i = 0; i < 2 * BLOCK * BLOCK; i++) {
					const int px = x + i % (2 * BLOCK), py = y + i / (2 * BLOCK);

					if (px >= o.x0 && px < o.x1 && py >= o.y0 && py < o.y1)
						store_pixel(t, px, py, counts);
				}
}

KERNEL_OF(float16) void camera_packet(KERNEL_ARGUMENTS(camera_packet))
{
	const struct camera_packet_arguments a = KERNEL_STRUCT(camera_packet);
	const uint item = (uint)get_global_id(0);
	struct tile t;

	if (item >= camera_packet_items(rectangle))
		return;
	t.x = camera_packet_x(rectangle, item);
	t.y = camera_packet_y(rectangle, item);
	tile_draw(&a, &t);
	store_tile(&t, counts);
}
