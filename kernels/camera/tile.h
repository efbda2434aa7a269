/*
 * A tile of 32 x 32 pixels of a view: its fragments, and how triangles are drawn into it. OpenCL C only. See
 * kernels/camera/camera.h.
 *
 * Triangles found in leaves are queued until there are sixteen, and then set up together (kernels/camera/batch.h). Each
 * is then drawn block by block, four rows of four pixels at once, since small triangles touch few blocks.
 */
#pragma once

#include "kernels/camera/batch.h"
#include "kernels/camera/camera.h"
#include "kernels/camera/coverage.h"
#include "kernels/camera/frustum.h"
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"

/* The far plane's lane in a tile's frustum. */
#define FAR_PLANE 5

/* Width and height of a block: sixteen pixels, four rows of four. */
#define BLOCK 4
#define TILE_BLOCKS (CAMERA_TILE / BLOCK)
#define BLOCK_X (PACK_LANES & 3)
#define BLOCK_Y (PACK_LANES >> 2)

/*
 * The state of a block. NEAREST: the nearest fragment; its depth is NO_DEPTH if there is none. COLUMN: the number of
 * fragments so far, the least order number that is accepted (SCENE_NONE for pixels outside the rectangle), and the
 * order number of the last fragment of a full column (SCENE_NONE if it is not full).
 */
#define NO_DEPTH 2.0f
struct camera_pack {
	packu order, instance, primitive;
	packf b1, b2, depth, steps; /* steps: depth in steps of 2^-24, as used in comparisons */
	packi counts;
	packu first, last;
};

/* Faces of a tile that will be drawn in draw order: a heap with the least order number on top. The lower half of a key
 * is the face's index. */
#define LISTED_FULL 512
struct listed {
	int is_used, is_drawn; /* some of them have been drawn already: later finds may precede them */
	uint n, least;         /* order numbers below `least` are ignored */
	ulong key[LISTED_FULL];
	uint instance[LISTED_FULL], place[LISTED_FULL]; /* place: eight times the number of the block, plus the lane */
};

/*
 * Queued triangles, of instances with the same flags. vertex: in the frame. The first sixteen are drawn once sixteen
 * more have arrived; meanwhile, the vertices of the later ones are prefetched.
 */
#define PENDING_FULL 32
struct pending {
	uint n, flags, instance[PENDING_FULL + 8], primitive[PENDING_FULL + 8], vertex[3][PENDING_FULL + 8];
};

struct tile {
	__global const struct view *view;
	__global const struct instance *instances;
	__global const struct node8 *nodes;
	__global const struct face8 *faces;
	__global const struct window_vertex *window;
	__global const float *clip;
	__global struct fragment *fragments;
	uint width, height, mode, first_pixel;
	int x, y;      /* the first pixel */
	struct camera_rectangle open; /* the rectangle's part of the tile, relative to its first pixel */
	packi off_x[TILE_BLOCKS], off_y[TILE_BLOCKS]; /* all ones for pixels that accept no fragments now */
	packf plane_x[TILE_BLOCKS], plane_y[TILE_BLOCKS]; /* sample positions in the pixels, in the planes' coordinates */
	int is_drawn;  /* 1: a fragment may have been drawn */
	int changed;   /* 1: a nearest fragment may have been replaced since far and z_far were set */
	struct batch_far far;
	float z_far;   /* in normalised device coordinates: everything behind it is hidden */
	struct pending pending;
	struct listed listed; /* for COLUMN */
	struct camera_pack packs[TILE_BLOCKS][TILE_BLOCKS];
};

/* A candidate fragment. */
struct candidate {
	uint order, instance, primitive;
};

#define LANE_INT(rows, lane) (((const int *)&(rows))[lane])
#define LANE_FLOAT(rows, lane) (((const float *)&(rows))[lane])

/*
 * Transposes quarters: quarter i of four vectors becomes row i. From adjacent blocks, this makes sixteen pixels of a
 * row.
 */
WIDE_VECTORS static inline void tile_quarters(packu a, packu b, packu c, packu d, packu *row)
{
	const packu ab = (packu)(a.lo, b.lo), cd = (packu)(c.lo, d.lo), ab_high = (packu)(a.hi, b.hi),
		    cd_high = (packu)(c.hi, d.hi);

	row[0] = (packu)(ab.s0123, ab.s89ab, cd.s0123, cd.s89ab);
	row[1] = (packu)(ab.s4567, ab.scdef, cd.s4567, cd.scdef);
	row[2] = (packu)(ab_high.s0123, ab_high.s89ab, cd_high.s0123, cd_high.s89ab);
	row[3] = (packu)(ab_high.s4567, ab_high.scdef, cd_high.s4567, cd_high.scdef);
}

/* --- fragments --------------------------------------------------------------------------------------------------- */

/* rint for numbers from 0 to 2^24; PoCL's own takes twenty instructions. From 2^23 on, floats have no fraction. */
WIDE_VECTORS static inline packf round_steps(packf x)
{
	return select((x + 0x1p23f) - 0x1p23f, x, x >= 0x1p23f);
}

/* Branchless, since which pixels accept a candidate cannot be predicted. */
WIDE_VECTORS static inline void keep_nearest(const struct tile *t, struct camera_pack *p, packi covered, packf b1,
                                             packf b2, packf depth, struct candidate c)
{
	const packi before = t->mode == CAMERA_NEAREST_LESS ? (packu)(c.order) < p->order : (packu)(c.order) > p->order;
	const packf steps = round_steps(depth * 16777215.0f);
	const packi better = covered & ((steps < p->steps) | ((steps == p->steps) & before));

	p->steps = select(p->steps, steps, better);
	p->order = select(p->order, (packu)(c.order), better);
	p->instance = select(p->instance, (packu)(c.instance), better);
	p->primitive = select(p->primitive, (packu)(c.primitive), better);
	p->b1 = select(p->b1, b1, better);
	p->b2 = select(p->b2, b2, better);
	p->depth = select(p->depth, depth, better);
}

/* Index of a pixel of the tile in the buffers. */
static inline size_t place_of(const struct tile *t, int x, int y)
{
	return (uint)(t->y + y) * t->width + (uint)(t->x + x) - t->first_pixel;
}

WIDE_VECTORS static inline void keep_in_columns(struct tile *t, int x, int y, packi covered, packf b1, packf b2,
                                                packf depth, struct candidate c)
{
	struct camera_pack *p = &t->packs[y][x];

	for (uint lanes = pack_bits(covered); lanes; lanes &= lanes - 1) {
		const int lane = (int)popcount((lanes & -lanes) - 1);
		const size_t pixel = place_of(t, BLOCK * x + lane % BLOCK, BLOCK * y + lane / BLOCK);
		__global struct fragment *column = t->fragments + pixel * CAMERA_COLUMN_MAX;
		int *count = (int *)&p->counts + lane, place = *count;

		while (place > 0 && column[place - 1].order > c.order)
			place--;
		/* A triangle may be in several leaves. */
		if (place > 0 && column[place - 1].order == c.order)
			continue;
		if (*count < CAMERA_COLUMN_MAX)
			++*count;
		for (int i = *count - 1; i > place; i--)
			column[i] = column[i - 1];
		column[place].order = c.order;
		column[place].instance = c.instance;
		column[place].primitive = c.primitive;
		column[place].b1 = LANE_FLOAT(b1, lane);
		column[place].b2 = LANE_FLOAT(b2, lane);
		column[place].depth = LANE_FLOAT(depth, lane);
		if (*count == CAMERA_COLUMN_MAX)
			((uint *)&p->last)[lane] = column[CAMERA_COLUMN_MAX - 1].order;
	}
}

/* The maximum of each of sixteen vectors, which are overwritten. */
WIDE_VECTORS static inline packf maxima(packf *v)
{
	for (int i = 0; i < 8; i++)
		v[i] = pack_max((packf)(v[2 * i].lo, v[2 * i + 1].lo), (packf)(v[2 * i].hi, v[2 * i + 1].hi));
	for (int i = 0; i < 4; i++)
		v[i] = pack_max((packf)(v[2 * i].s012389ab, v[2 * i + 1].s012389ab),
		                (packf)(v[2 * i].s4567cdef, v[2 * i + 1].s4567cdef));
	for (int i = 0; i < 2; i++)
		v[i] = pack_max((packf)(v[2 * i].s014589cd, v[2 * i + 1].s014589cd),
		                (packf)(v[2 * i].s2367abef, v[2 * i + 1].s2367abef));
	return pack_max((packf)(v[0].even, v[1].even), (packf)(v[0].odd, v[1].odd));
}

/* Find the farthest of the nearest fragments, per cell and overall, and move the far plane up to it. */
WIDE_VECTORS static inline void shorten(struct tile *t)
{
	const float near = t->view->depth_range[0], range = t->view->depth_range[1] - near;
	packf cell[16];
	float8 eight;
	float4 four;
	float2 two;

	t->changed = 0;
	for (int i = 0; i < 16; i++) {
		const struct camera_pack *above = &t->packs[i / 4 * 2][i % 4 * 2], *below = above + TILE_BLOCKS;

		cell[i] = pack_max(pack_max(above[0].depth, above[1].depth), pack_max(below[0].depth, below[1].depth));
	}
	t->far.cells = maxima(cell);
	eight = lanes_max(t->far.cells.lo, t->far.cells.hi);
	four = fmax(eight.lo, eight.hi);
	two = fmax(four.lo, four.hi);
	t->far.all = fmax(two.lo, two.hi);
	/*
	 * Otherwise the nearest depth is not the first along the ray. One step more, for equal depths, plus what rounding
	 * may do.
	 */
	if (range > 0 && t->far.all < NO_DEPTH)
		t->z_far = fmin(2.0f * ((t->far.all - near) / range + 5e-7f) - 1.0f, 1.0f);
}

/* --- coverage ---------------------------------------------------------------------------------------------------- */

/* The weight of the corner opposite edge 1 + i at the pixels of a block: the edge function's value, rounded once, over
 * the whole triangle's. */
WIDE_VECTORS static inline packf weight_at(const struct batch *s, uint lane, int i, uint x, uint y, packi at)
{
	packf rounded;

	if (LANE_INT(s->small, lane)) {
		rounded = convert_float16(at * 256 + LANE_INT(s->rest[i], lane));
	} else {
		const long value = ((const long *)&s->value[i])[lane];
		const packi step_x = LANE_INT(s->step_x[1 + i], lane), step_y = LANE_INT(s->step_y[1 + i], lane);

		rounded = convert_float16((long16)(value) +
		                          (convert_long16(BLOCK_Y + BLOCK * (int)y) * convert_long16(step_y) +
		                           convert_long16(BLOCK_X + BLOCK * (int)x) * convert_long16(step_x)) *
		                                  256);
	}
	return rounded * LANE_FLOAT(s->inverse, lane);
}

/*
 * Weights in the volume, for a triangle that is part of one that leaves it: the fragments' weights are those of the
 * whole triangle.
 */
WIDE_VECTORS static inline void weigh_in_volume(const struct clip_corner *const *corner, packf *b1, packf *b2)
{
	const packf p0 = (1.0f - *b1 - *b2) * corner[0]->window.w_inv, p1 = *b1 * corner[1]->window.w_inv;
	const packf p2 = *b2 * corner[2]->window.w_inv, sum = p0 + p1 + p2;

	*b1 = (p0 * corner[0]->b1 + p1 * corner[1]->b1 + p2 * corner[2]->b1) / sum;
	*b2 = (p0 * corner[0]->b2 + p1 * corner[1]->b2 + p2 * corner[2]->b2) / sum;
}

WIDE_VECTORS static inline packf clamp_depth(packf depth)
{
	depth = select(depth, (packf)(1), depth > 1.0f);
	return select(depth, (packf)(0), depth < 0.0f);
}

/*
 * Draw what one triangle of a batch covers of a block. at: its edge functions there. corner: NULL, or the three corners
 * of a part
 */
WIDE_VECTORS static inline void draw_block(struct tile *t, const struct batch *s, uint lane, uint x, uint y,
                                           packi covered, const packi *at, const struct clip_corner *const *corner,
                                           struct candidate c)
{
	const int exact = t->mode != CAMERA_COLUMN && LANE_INT(s->exact, lane);
	struct camera_pack *p = &t->packs[y][x];
	packf depth, b1, b2;

	if (t->mode == CAMERA_COLUMN)
		covered &= (c.order >= p->first) & (c.order < p->last);
	if (!any_pack(covered))
		return;
	b1 = weight_at(s, lane, 0, x, y, at[1]);
	b2 = weight_at(s, lane, 1, x, y, at[2]);
	if (exact)
		depth = clamp_depth(fma((packf)(LANE_FLOAT(s->along_y, lane)), t->plane_y[y],
		                        fma((packf)(LANE_FLOAT(s->along_x, lane)), t->plane_x[x],
		                            (packf)(LANE_FLOAT(s->origin, lane)))));
	else
		depth = clamp_depth(LANE_FLOAT(s->z, lane) +
		                    (b1 * LANE_FLOAT(s->along_b1, lane) + b2 * LANE_FLOAT(s->along_b2, lane)));
	if (corner)
		weigh_in_volume(corner, &b1, &b2);
	if (t->mode == CAMERA_COLUMN) {
		keep_in_columns(t, x, y, covered, b1, b2, depth, c);
		return;
	}
	keep_nearest(t, p, covered, b1, b2, depth, c);
}

/* Draw all that one triangle of a batch covers. */
WIDE_VECTORS static inline void draw_triangle(struct tile *t, const struct batch *s, uint lane,
                                              const struct clip_corner *const *corner, struct candidate c)
{
	const uint x_first = (uint)LANE_INT(s->x_first, lane) / BLOCK, x_last = (uint)LANE_INT(s->x_last, lane) / BLOCK;
	const uint y_first = (uint)LANE_INT(s->y_first, lane) / BLOCK, y_last = (uint)LANE_INT(s->y_last, lane) / BLOCK;
	const packi x0 = BLOCK_X + BLOCK * (int)x_first, y0 = BLOCK_Y + BLOCK * (int)y_first;
	const packi step_x[3] = { LANE_INT(s->step_x[0], lane), LANE_INT(s->step_x[1], lane), LANE_INT(s->step_x[2], lane) };
	const packi step_y[3] = { LANE_INT(s->step_y[0], lane), LANE_INT(s->step_y[1], lane), LANE_INT(s->step_y[2], lane) };
	packi row[3] = { LANE_INT(s->whole[0], lane) + x0 * step_x[0] + y0 * step_y[0],
		         LANE_INT(s->whole[1], lane) + x0 * step_x[1] + y0 * step_y[1],
		         LANE_INT(s->whole[2], lane) + x0 * step_x[2] + y0 * step_y[2] };

	for (uint y = y_first; y <= y_last; y++) {
		packi at[3] = { row[0], row[1], row[2] };

		for (uint x = x_first; x <= x_last; x++) {
			const packi covered = (at[0] | at[1] | at[2] | t->off_x[x] | t->off_y[y]) >= 0;

			draw_block(t, s, lane, x, y, covered, at, corner, c);
			at[0] += BLOCK * step_x[0];
			at[1] += BLOCK * step_x[1];
			at[2] += BLOCK * step_x[2];
		}
		row[0] += BLOCK * step_y[0];
		row[1] += BLOCK * step_y[1];
		row[2] += BLOCK * step_y[2];
	}
}

/* A corner has no place in the window: draw what the view volume leaves of the triangle. vertex: indices in clip. */
static inline void draw_clipped(struct tile *t, uint flags, const uint *vertex, struct candidate c)
{
	struct clip_polygon polygon;
	struct batch_corners v;
	struct batch batch;

	clip_triangle(t->view, (float)t->height, v4_load(t->clip + 4 * (size_t)vertex[0]),
	              v4_load(t->clip + 4 * (size_t)vertex[1]), v4_load(t->clip + 4 * (size_t)vertex[2]), &polygon);
	if (polygon.n < 3)
		return;
	for (uint lane = 0; lane < 16; lane++)
		for (uint i = 0; i < 3; i++) {
			const struct clip_corner *from = &polygon.corner[i == 2 ? 0 : min(lane + 1 + i, polygon.n - 1)];

			((int *)&v.x[i])[lane] = from->window.x;
			((int *)&v.y[i])[lane] = from->window.y;
			((float *)&v.z[i])[lane] = from->window.z;
			((float *)&v.place_x[i])[lane] = from->place[0] - clip_origin(t->view);
			((float *)&v.place_y[i])[lane] = from->place[1] - clip_origin(t->view);
		}
	for (uint lanes = batch_set_up(t->view, t->height, t->x, t->y, flags, &v, PACK_LANES < (int)polygon.n - 2,
	                               &t->far, &batch);
	     lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		const struct clip_corner *corner[3] = { &polygon.corner[lane + 1], &polygon.corner[lane + 2], &polygon.corner[0] };

		draw_triangle(t, &batch, lane, corner, c);
	}
}

/* Draw the first sixteen pending faces, or fewer if there are fewer. */
WIDE_VECTORS static inline void draw_pending(struct tile *t)
{
	struct pending *pending = &t->pending;
	const uint n = min(pending->n, 16u);
	const packi there = PACK_LANES < (int)n;
	struct batch_corners v;
	struct batch batch;
	packu vertex[3];
	packi placed;
	uint clipped;

	for (int i = 0; i < 3; i++)
		vertex[i] = select((packu)(pending->vertex[i][0]), vload16(0, pending->vertex[i]), there);
	t->is_drawn = 1;
	t->changed = t->mode != CAMERA_COLUMN;
	placed = batch_load(t->view, (float)t->height, t->window, t->clip, vertex, &v);
	clipped = pack_bits(there & ~placed);
	for (uint lanes =
	             batch_set_up(t->view, t->height, t->x, t->y, pending->flags, &v, there & placed, &t->far, &batch);
	     lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1), primitive = pending->primitive[lane],
			   index = pending->instance[lane];
		const struct candidate c = { t->instances[index].primitive_first + primitive, index, primitive };

		draw_triangle(t, &batch, lane, 0, c);
	}
	for (; clipped; clipped &= clipped - 1) {
		const uint lane = popcount((clipped & -clipped) - 1), primitive = pending->primitive[lane],
			   index = pending->instance[lane];
		const struct candidate c = { t->instances[index].primitive_first + primitive, index,
			                     primitive | FRAGMENT_PERSPECTIVE };
		const uint corner[3] = { LANE_INT(vertex[0], lane), LANE_INT(vertex[1], lane), LANE_INT(vertex[2], lane) };

		draw_clipped(t, pending->flags, corner, c);
	}
	pending->n -= n;
	for (uint k = 0; 8 * k < pending->n; k++) {
		vstore8(vload8(k + 2, pending->instance), k, pending->instance);
		vstore8(vload8(k + 2, pending->primitive), k, pending->primitive);
		for (int i = 0; i < 3; i++)
			vstore8(vload8(k + 2, pending->vertex[i]), k, pending->vertex[i]);
	}
}
