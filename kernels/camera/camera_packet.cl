/*
 * camera_packet: a tile of 32 x 32 pixels a work item. See kernels/camera/camera.h.
 *
 * The tile's rays go through the trees as one frustum against eight boxes at once, nearest child first. Of the tile's nearest
 * fragments the farthest cuts the frustum off. Triangles of leaves wait until there are sixteen, and are then set up at once
 * (kernels/camera/batch.h). Each is then drawn block by block, four rows of four pixels at once: small triangles meet few blocks.
 *
 * Columns that go on from an earlier launch are often deep. Their tiles first list all faces, and draw them in draw order until no pixel
 * has room: a face that comes too early or too late is not set up.
 */
#include "kernels/camera/batch.h"
#include "kernels/camera/camera.h"
#include "kernels/camera/coverage.h"
#include "kernels/camera/frustum.h"
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"

/* The far plane's lane in a tile's frustum. */
#define FAR_PLANE 5

/* Sixteen pixels: a block of four rows of four. */
#define BLOCK 4
#define TILE_BLOCKS (CAMERA_TILE / BLOCK)
#define BLOCK_X (PACK_LANES & 3)
#define BLOCK_Y (PACK_LANES >> 2)

/*
 * The state of a block. NEAREST: the nearest fragment, of depth NO_DEPTH where there is none. COLUMN: how many fragments so far, the least
 * order number that counts (SCENE_NONE where pixels do not), and that of the last fragment of a full column, SCENE_NONE of another.
 */
#define NO_DEPTH 2.0f
struct camera_pack {
	packu order, instance, primitive;
	packf b1, b2, depth, steps; /* steps: depth in steps of 2^-24, as it is compared */
	packi counts;
	packu first, last;
};

/* Faces of a tile to be drawn in draw order: a heap, the least order number on top; the lower half of a key says where the face stands. */
#define LISTED_FULL 512
struct listed {
	int is_used, is_drawn; /* a part of them has been drawn already: later ones may come before them */
	uint n, least;         /* order numbers below the least do not count */
	ulong key[LISTED_FULL];
	uint instance[LISTED_FULL], place[LISTED_FULL]; /* place: eight times the block of faces, and its lane */
};

/*
 * Triangles that wait, of instances of the same flags. vertex: in the frame. The first sixteen are drawn when sixteen more have come: the
 * vertices of the later ones are prefetched meanwhile.
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
	struct camera_rectangle open; /* pixels of the tile that count, from its first one */
	packi off_x[TILE_BLOCKS], off_y[TILE_BLOCKS]; /* all ones where a pixel takes no fragments now */
	packf plane_x[TILE_BLOCKS], plane_y[TILE_BLOCKS]; /* where a view looks in the pixels, as planes count */
	int changed;   /* a nearest fragment may have been replaced since far and z_far were set */
	struct batch_far far;
	float z_far;   /* in normalised device coordinates: nothing behind it matters */
	struct pending pending;
	struct listed listed; /* COLUMN */
	struct camera_pack packs[TILE_BLOCKS][TILE_BLOCKS];
};

/* A candidate: its numbers. */
struct candidate {
	uint order, instance, primitive;
};

#define LANE_INT(rows, lane) (((const int *)&(rows))[lane])
#define LANE_FLOAT(rows, lane) (((const float *)&(rows))[lane])

/* --- fragments --- */

/* What rint does to numbers from 0 to 2^24; PoCL's own takes twenty instructions. From 2^23 on they have no fraction. */
WIDE_VECTORS static inline packf round_steps(packf x)
{
	return select((x + 0x1p23f) - 0x1p23f, x, x >= 0x1p23f);
}

/* No branches: which pixels take a candidate cannot be foretold. */
WIDE_VECTORS static inline void keep_nearest(const struct tile *t, struct camera_pack *p, packi covered, packf b1, packf b2, packf depth, struct candidate c)
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

/* Where a pixel of the tile stands in the buffers. */
static inline size_t place_of(const struct tile *t, int x, int y)
{
	return (uint)(t->y + y) * t->width + (uint)(t->x + x) - t->first_pixel;
}

WIDE_VECTORS static inline void keep_in_columns(struct tile *t, int x, int y, packi covered, packf b1, packf b2, packf depth, struct candidate c)
{
	struct camera_pack *p = &t->packs[y][x];

	for (uint lanes = pack_bits(covered); lanes; lanes &= lanes - 1) {
		const int lane = (int)popcount((lanes & -lanes) - 1);
		const size_t pixel = place_of(t, BLOCK * x + lane % BLOCK, BLOCK * y + lane / BLOCK);
		__global struct fragment *column = t->fragments + pixel * CAMERA_COLUMN_MAX;
		int *count = (int *)&p->counts + lane, place = *count;

		while (place > 0 && column[place - 1].order > c.order)
			place--;
		/* A triangle may lie in several leaves. */
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

/* The greatest number of each of sixteen vectors, which are overwritten. */
WIDE_VECTORS static inline packf maxima(packf *v)
{
	for (int i = 0; i < 8; i++)
		v[i] = pack_max((packf)(v[2 * i].lo, v[2 * i + 1].lo), (packf)(v[2 * i].hi, v[2 * i + 1].hi));
	for (int i = 0; i < 4; i++)
		v[i] = pack_max((packf)(v[2 * i].s012389ab, v[2 * i + 1].s012389ab), (packf)(v[2 * i].s4567cdef, v[2 * i + 1].s4567cdef));
	for (int i = 0; i < 2; i++)
		v[i] = pack_max((packf)(v[2 * i].s014589cd, v[2 * i + 1].s014589cd), (packf)(v[2 * i].s2367abef, v[2 * i + 1].s2367abef));
	return pack_max((packf)(v[0].even, v[1].even), (packf)(v[0].odd, v[1].odd));
}

/* Find the farthest of the nearest fragments, of cells and of all, and move the far plane up to that. */
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
	/* Else the nearest depth is not the first along the ray. A step more, for equal depths, and what rounding may do. */
	if (range > 0 && t->far.all < NO_DEPTH)
		t->z_far = fmin(2.0f * ((t->far.all - near) / range + 5e-7f) - 1.0f, 1.0f);
}

/* --- coverage --- */

/* The weight of edge 1 + i's corner in the pixels of a block: its function's value, rounded once, in the whole triangle's. */
WIDE_VECTORS static inline packf weight_at(const struct batch *s, uint lane, int i, uint x, uint y, packi at)
{
	packf rounded;

	if (LANE_INT(s->small, lane)) {
		rounded = convert_float16(at * 256 + LANE_INT(s->rest[i], lane));
	} else {
		const long value = ((const long *)&s->value[i])[lane];
		const packi step_x = LANE_INT(s->step_x[1 + i], lane), step_y = LANE_INT(s->step_y[1 + i], lane);

		rounded = convert_float16((long16)(value) + (convert_long16(BLOCK_Y + BLOCK * (int)y) * convert_long16(step_y) +
		                                             convert_long16(BLOCK_X + BLOCK * (int)x) * convert_long16(step_x)) * 256);
	}
	return rounded * LANE_FLOAT(s->inverse, lane);
}

/* In the volume, where the triangle is part of one that leaves it: the fragments' weights are those of the whole. */
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

/* What one triangle of a batch covers of a block. at: its edges there. corner: NULL, or the three of a part of one. */
WIDE_VECTORS static inline void draw_block(struct tile *t, const struct batch *s, uint lane, uint x, uint y, packi covered, const packi *at,
                                           const struct clip_corner *const *corner, struct candidate c)
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
		                        fma((packf)(LANE_FLOAT(s->along_x, lane)), t->plane_x[x], (packf)(LANE_FLOAT(s->origin, lane)))));
	else
		depth = clamp_depth(LANE_FLOAT(s->z, lane) + (b1 * LANE_FLOAT(s->along_b1, lane) + b2 * LANE_FLOAT(s->along_b2, lane)));
	if (corner)
		weigh_in_volume(corner, &b1, &b2);
	if (t->mode == CAMERA_COLUMN) {
		keep_in_columns(t, x, y, covered, b1, b2, depth, c);
		return;
	}
	keep_nearest(t, p, covered, b1, b2, depth, c);
}

/* All that one triangle of a batch covers. */
WIDE_VECTORS static inline void draw_triangle(struct tile *t, const struct batch *s, uint lane, const struct clip_corner *const *corner,
                                              struct candidate c)
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

/* A corner has no place in the window: what the view volume leaves of the triangle is asked. vertex: places in clip. */
static inline void draw_clipped(struct tile *t, uint flags, const uint *vertex, struct candidate c)
{
	struct clip_polygon polygon;
	struct batch_corners v;
	struct batch batch;

	clip_triangle(t->view, (float)t->height, v4_load(t->clip + 4 * (size_t)vertex[0]), v4_load(t->clip + 4 * (size_t)vertex[1]),
	              v4_load(t->clip + 4 * (size_t)vertex[2]), &polygon);
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
	for (uint lanes = batch_set_up(t->view, t->height, t->x, t->y, flags, &v, PACK_LANES < (int)polygon.n - 2, &t->far, &batch); lanes;
	     lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		const struct clip_corner *corner[3] = { &polygon.corner[lane + 1], &polygon.corner[lane + 2], &polygon.corner[0] };

		draw_triangle(t, &batch, lane, corner, c);
	}
}

/* The first sixteen pending faces, or as many as there are. */
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
	t->changed = t->mode != CAMERA_COLUMN;
	placed = batch_load(t->view, (float)t->height, t->window, t->clip, vertex, &v);
	clipped = pack_bits(there & ~placed);
	for (uint lanes = batch_set_up(t->view, t->height, t->x, t->y, pending->flags, &v, there & placed, &t->far, &batch); lanes;
	     lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1), primitive = pending->primitive[lane], index = pending->instance[lane];
		const struct candidate c = { t->instances[index].primitive_first + primitive, index, primitive };

		draw_triangle(t, &batch, lane, 0, c);
	}
	for (; clipped; clipped &= clipped - 1) {
		const uint lane = popcount((clipped & -clipped) - 1), primitive = pending->primitive[lane], index = pending->instance[lane];
		const struct candidate c = { t->instances[index].primitive_first + primitive, index, primitive | FRAGMENT_PERSPECTIVE };
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

/* --- faces in draw order --- */

/* Whether pixels that take fragments now have room in their columns. */
WIDE_VECTORS static inline int has_room(const struct tile *t)
{
	packi room = 0;

	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x++) {
			const struct camera_pack *p = &t->packs[y][x];

			room |= (p->first != SCENE_NONE) & (p->counts < CAMERA_COLUMN_MAX) & ~(t->off_x[x] | t->off_y[y]);
		}
	return any_pack(room);
}

/* Move a key of the heap down to where it belongs. */
static inline void sink(struct listed *l, uint at)
{
	const ulong key = l->key[at];

	for (uint child = 2 * at + 1; child < l->n; child = 2 * at + 1) {
		child += child + 1 < l->n && l->key[child + 1] < l->key[child];
		if (l->key[child] >= key)
			break;
		l->key[at] = l->key[child];
		at = child;
	}
	l->key[at] = key;
}

/* Up to sixteen of the list's first faces wait now, of instances of the same flags. A face may lie in several leaves, and is taken once. */
static inline void take_listed(struct tile *t)
{
	struct pending *pending = &t->pending;
	struct listed *l = &t->listed;
	uint last = SCENE_NONE;

	while (l->n && pending->n < 16) {
		const uint order = (uint)(l->key[0] >> 32), entry = (uint)l->key[0], index = l->instance[entry], lane = l->place[entry] % 8;
		__global const struct face8 *faces = &t->faces[l->place[entry] / 8];
		__global const struct instance *instance = &t->instances[index];

		if (pending->n && instance->flags != pending->flags)
			return;
		if (order != last) {
			pending->flags = instance->flags;
			pending->instance[pending->n] = index;
			pending->primitive[pending->n] = faces->primitive[lane];
			for (int i = 0; i < 3; i++)
				pending->vertex[i][pending->n] = instance->vertex_first + faces->vertex[i][lane];
			pending->n++;
		}
		last = order;
		l->key[0] = l->key[--l->n];
		sink(l, 0);
	}
}

/* Draw the list, as far as it can come into columns. What is drawn later may come before. */
static inline void draw_listed(struct tile *t)
{
	struct listed *l = &t->listed;

	for (uint i = l->n / 2; i-- > 0;)
		sink(l, i);
	while (l->n && (l->is_drawn || has_room(t))) {
		take_listed(t);
		draw_pending(t);
	}
	l->is_drawn = 1;
	l->n = 0;
}

/* A block of faces of an instance for the list. place: among all blocks */
static inline void list_faces(struct tile *t, uint index, uint place)
{
	const uint first = t->instances[index].primitive_first;
	__global const struct face8 *faces = &t->faces[place];
	struct listed *l = &t->listed;

	if (l->n + 8 > LISTED_FULL)
		draw_listed(t);
	for (uint lane = 0; lane < 8; lane++) {
		if (faces->primitive[lane] == SCENE_NONE || first + faces->primitive[lane] < l->least)
			continue;
		l->key[l->n] = (ulong)(first + faces->primitive[lane]) << 32 | l->n;
		l->instance[l->n] = index;
		l->place[l->n++] = 8 * place + lane;
	}
}

/* A block of faces of an instance waits now, or is listed; the first sixteen are drawn where that is enough. place: among all blocks */
static inline void add_faces(struct tile *t, uint index, uint place)
{
	const uint vertex_first = t->instances[index].vertex_first;
	__global const struct face8 *faces = &t->faces[place];
	struct pending *pending = &t->pending;
	const uint n = pending->n;

	if (t->listed.is_used) {
		list_faces(t, index, place);
		return;
	}
	pending->flags = t->instances[index].flags;
	vstore8((uint8)(index), 0, pending->instance + n);
	vstore8(vload8(0, faces->primitive), 0, pending->primitive + n);
	for (int i = 0; i < 3; i++)
		vstore8(vertex_first + vload8(0, faces->vertex[i]), 0, pending->vertex[i] + n);
	for (int i = 0; i < 3; i++)
		for (int lane = 0; lane < 8; lane++) {
			const size_t vertex = vertex_first + faces->vertex[i][lane];

			PREFETCH(t->window + vertex);
			PREFETCH(t->clip + 4 * vertex);
		}
	pending->n = n + popcount(lane_bits(vload8(0, faces->primitive) != SCENE_NONE));
	if (pending->n >= PENDING_FULL)
		draw_pending(t);
}

/* --- traversal --- */

/* Where the view looks, pixels from their centres. */
static inline float tile_sample(const struct tile *t, int axis)
{
	return (float)t->view->sample[axis] * 0.00390625f;
}

/*
 * The tile's frustum in the space that `m` (3 rows of 4; NULL: eye space) leads from into eye space. With clip
 * coordinates x y z w, a pixel centre between X0 and X1 means X0 w <= x <= X1 w, and so on; all are linear in the point.
 */
static inline struct frustum tile_frustum(const struct tile *t, __global const float *m, struct vec3 extent)
{
	__global const struct view *view = t->view;
	__global const float *p = view->projection;
	const float scale_x = 2.0f / view->viewport[2], scale_y = 2.0f / view->viewport[3];
	const float left = (float)t->x + tile_sample(t, 0) - view->viewport[0];
	const float low = (float)t->y + tile_sample(t, 1) - view->viewport[1];
	/* A pixel's hundredth more: snapping moves edges by 1/512. */
	const float x0 = (left + 0.49f) * scale_x - 1.0f, x1 = (left + CAMERA_TILE - 0.49f) * scale_x - 1.0f;
	const float y0 = (low + 0.49f) * scale_y - 1.0f, y1 = (low + CAMERA_TILE - 0.49f) * scale_y - 1.0f;
	/* Lanes: left, right, bottom, top, near, far, in front of the viewer, and one that is always met. */
	const float8 of_x = (float8)(1, -1, 0, 0, 0, 0, 0, 0), of_y = (float8)(0, 0, 1, -1, 0, 0, 0, 0);
	const float8 of_z = (float8)(0, 0, 0, 0, 1, -1, 0, 0), of_w = (float8)(-x0, x1, -y0, y1, 1, t->z_far, 1, 0);
	float8 e[4], abs_e[4], o[4], abs_o[4];

	for (int i = 0; i < 4; i++) {
		e[i] = of_x * p[4 * i] + of_y * p[4 * i + 1] + of_z * p[4 * i + 2] + of_w * p[4 * i + 3];
		abs_e[i] = fabs(of_x * p[4 * i]) + fabs(of_y * p[4 * i + 1]) + fabs(of_z * p[4 * i + 2]) +
		           fabs(of_w * p[4 * i + 3]);
	}
	if (!m)
		return frustum_make(e[0], e[1], e[2], e[3], abs_e[0], abs_e[1], abs_e[2], abs_e[3], extent);
	for (int i = 0; i < 4; i++) {
		o[i] = e[0] * m[i] + e[1] * m[4 + i] + e[2] * m[8 + i] + (i == 3 ? e[3] : (float8)(0));
		abs_o[i] = abs_e[0] * fabs(m[i]) + abs_e[1] * fabs(m[4 + i]) + abs_e[2] * fabs(m[8 + i]) +
		           (i == 3 ? abs_e[3] : (float8)(0));
	}
	return frustum_make(o[0], o[1], o[2], o[3], abs_o[0], abs_o[1], abs_o[2], abs_o[3], extent);
}

/* A node, or a leaf of `count` blocks of faces, and how far it reaches before the far plane. */
struct tile_entry {
	float reach;
	uint child, count;
};

/* Push the children of a node that the tile may see; the one that reaches farthest before the far plane is popped first. nodes, faces:
 * the instance's. */
static inline uint tile_push_children(const struct frustum8 *f, __global const struct node8 *nodes, __global const struct face8 *faces,
                                 uint index, struct tile_entry *stack, uint depth)
{
	__global const struct node8 *node = &nodes[index];
	const uint bottom = depth;
	float8 reach;

	for (uint bits = frustum8_meets(f, node, &reach); bits; bits &= bits - 1) {
		const uint lane = popcount((bits & -bits) - 1);
		const float r = LANE_FLOAT(reach, lane);
		uint place = depth++;

		for (; place > bottom && stack[place - 1].reach > r; place--)
			stack[place] = stack[place - 1];
		stack[place].reach = r;
		stack[place].child = node->child[lane];
		stack[place].count = node->count[lane];
		if (node->count[lane]) {
			PREFETCH(faces[node->child[lane]].vertex[0]);
			PREFETCH(faces[node->child[lane]].vertex[2]);
		} else {
			__global const float *row = (__global const float *)&nodes[node->child[lane]];

			for (int i = 0; i < 8; i += 2)
				PREFETCH(row + 8 * i);
		}
	}
	return depth;
}

static inline struct frustum8 instance_frustum(const struct tile *t, __global const struct instance *instance)
{
	const float r = instance->radius;
	const struct vec3 extent = v3(fabs(instance->centre[0]) + r, fabs(instance->centre[1]) + r, fabs(instance->centre[2]) + r);

	return frustum8_from(tile_frustum(t, instance->eye_from_obj, extent), FAR_PLANE);
}

static inline void tile_walk_blas(struct tile *t, uint index)
{
	__global const struct instance *instance = &t->instances[index];
	__global const struct node8 *nodes = t->nodes + instance->node8_first;
	__global const struct face8 *faces = t->faces + instance->triangle8_first;
	struct frustum8 f = instance_frustum(t, instance);
	struct tile_entry stack[RAYS_WIDE_STACK], entry = { 0, 0, 0 }, leaf = { 0, 0, 0 };
	uint depth = 0;

	for (;;) {
		if (entry.count == 0) {
			depth = tile_push_children(&f, nodes, faces, entry.child, stack, depth);
		} else {
			/* A leaf's faces are on their way for as long as another leaf's are added. */
			for (uint i = 0; i < leaf.count; i++)
				add_faces(t, index, instance->triangle8_first + leaf.child + i);
			leaf = entry;
		}
		if (!depth) {
			for (uint i = 0; i < leaf.count; i++)
				add_faces(t, index, instance->triangle8_first + leaf.child + i);
			leaf.count = 0;
			while (t->pending.n)
				draw_pending(t);
		}
		if (t->changed) {
			const float before = t->z_far;

			shorten(t);
			if (t->z_far < before)
				f = instance_frustum(t, instance);
		}
		if (depth == 0)
			return;
		entry = stack[--depth];
	}
}

static inline void tile_walk_top(struct tile *t, __global const struct node2 *top, __global const uint *instance_list)
{
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &top[stack[--depth]];
		const struct frustum f = tile_frustum(t, 0, frustum_extent(top));
		const int first = frustum_reach(&f, node, 1).s5 > frustum_reach(&f, node, 0).s5;

		/* Nearest first: instances at once, of inner children the farther one is pushed before the nearer. */
		for (int i = 0; i < 2; i++) {
			const uint side = first ^ i;

			if (node->count[side] == 0 || !frustum_meets(frustum_reach(&f, node, side)))
				continue;
			for (uint k = 0; k < node->count[side]; k++)
				tile_walk_blas(t, instance_list[node->child[side] + k]);
		}
		for (int i = 0; i < 2; i++) {
			const uint side = !(first ^ i);

			if (node->count[side] == 0 && side_exists(node, side) && frustum_meets(frustum_reach(&f, node, side)))
				stack[depth++] = node->child[side];
		}
	}
}

/* Geometry in window space: where the view looks in pixels are points. */
static inline void walk_screen(struct tile *t, uint index)
{
	__global const struct instance *instance = &t->instances[index];
	__global const struct node8 *nodes = t->nodes + instance->node8_first;
	const float left = (float)t->x + tile_sample(t, 0), low = (float)t->y + tile_sample(t, 1), pad = instance->pad;
	const float x0 = left + 0.5f - pad, x1 = left + CAMERA_TILE - 0.5f + pad;
	const float y0 = low + 0.5f - pad, y1 = low + CAMERA_TILE - 0.5f + pad;
	uint stack[RAYS_WIDE_STACK], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node8 *node = &nodes[stack[--depth]];
		const int8 meets = (x1 >= vload8(0, node->lo[0])) & (x0 <= vload8(0, node->hi[0])) & (y1 >= vload8(0, node->lo[1])) &
		                   (y0 <= vload8(0, node->hi[1]));

		for (uint bits = lane_bits(meets); bits; bits &= bits - 1) {
			const uint lane = popcount((bits & -bits) - 1);

			if (node->count[lane] == 0)
				stack[depth++] = node->child[lane];
			for (uint i = 0; i < node->count[lane]; i++)
				add_faces(t, index, instance->triangle8_first + node->child[lane] + i);
		}
	}
	while (t->pending.n)
		draw_pending(t);
}

/* Pixels of the tile between places x0 and x1, y0 and y1 take fragments from now on. */
WIDE_VECTORS static inline void open_pixels(struct tile *t, float x0, float y0, float x1, float y1)
{
	for (int i = 0; i < TILE_BLOCKS; i++) {
		const packf px = convert_float16(t->x + BLOCK * i + BLOCK_X) + 0.5f + tile_sample(t, 0);
		const packf py = convert_float16(t->y + BLOCK * i + BLOCK_Y) + 0.5f + tile_sample(t, 1);

		t->off_x[i] = ~((px >= x0) & (px < x1));
		t->off_y[i] = ~((py >= y0) & (py < y1));
	}
}

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

/* Of each row of a block, four numbers a row: the first two of a and of b by turns, the last two; halves of a and of b. */
#define STORE_LOW(a, b) (packu)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc, b.sc, a.sd, b.sd)
#define STORE_HIGH(a, b) (packu)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se, b.se, a.sf, b.sf)
#define STORE_FIRST(a, b) (packu)(a.s01, b.s01, a.s45, b.s45, a.s89, b.s89, a.scd, b.scd)
#define STORE_LAST(a, b) (packu)(a.s23, b.s23, a.s67, b.s67, a.sab, b.sab, a.sef, b.sef)
#define STORE_FIRST_LAST(a, b) (packu)(a.s01, b.s23, a.s45, b.s67, a.s89, b.sab, a.scd, b.sef)
#define STORE_LAST_FIRST(a, b) (packu)(a.s23, b.s01, a.s67, b.s45, a.sab, b.s89, a.sef, b.scd)

/* A block's fragments, six numbers each: of each row, its quarter of all six vectors one after the other. */
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
WIDE_VECTORS static inline void store_rows(packu a, packu b, packu c, packu d, __global uint *to, size_t stride, int aligned)
{
	const packu ab = (packu)(a.lo, b.lo), cd = (packu)(c.lo, d.lo), ab_high = (packu)(a.hi, b.hi), cd_high = (packu)(c.hi, d.hi);

	store_pack((packu)(ab.s0123, ab.s89ab, cd.s0123, cd.s89ab), to, aligned);
	store_pack((packu)(ab.s4567, ab.scdef, cd.s4567, cd.scdef), to + stride, aligned);
	store_pack((packu)(ab_high.s0123, ab_high.s89ab, cd_high.s0123, cd_high.s89ab), to + 2 * stride, aligned);
	store_pack((packu)(ab_high.s4567, ab_high.scdef, cd_high.s4567, cd_high.scdef), to + 3 * stride, aligned);
}

/* Two blocks side by side whose pixels all count: three times sixteen numbers a row. */
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

/* The pixels that count. */
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

/* Of a block's pixels, the least order numbers that count. after: of pixels, as camera.h has it */
static inline packu columns_begin(const struct tile *t, int x, int y, __global const uint *after)
{
	packu first = SCENE_NONE;

	for (int lane = 0; lane < 16; lane++) {
		const int px = BLOCK * x + lane % BLOCK, py = BLOCK * y + lane / BLOCK;

		if (px >= t->open.x0 && px < t->open.x1 && py >= t->open.y0 && py < t->open.y1)
			((uint *)&first)[lane] = after[place_of(t, px, py)];
	}
	return first;
}

static inline void clear_columns(struct tile *t, __global const uint *after)
{
	packu least = SCENE_NONE;

	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x++) {
			struct camera_pack *p = &t->packs[y][x];

			p->first = columns_begin(t, x, y, after);
			p->last = SCENE_NONE;
			p->counts = 0;
			least = min(least, p->first);
		}
	t->listed.least = SCENE_NONE;
	for (int lane = 0; lane < 16; lane++)
		t->listed.least = min(t->listed.least, ((const uint *)&least)[lane]);
	t->listed.is_used = t->listed.least > 0;
	t->listed.is_drawn = 0;
	t->listed.n = 0;
}

WIDE_VECTORS static inline void clear_tile(struct tile *t)
{
	const float row = clip_from_origin(t->view, (int)t->height - 1 - t->y, -t->view->sample[1]);

	t->changed = 0;
	t->z_far = 1;
	t->far.cells = t->far.all = NO_DEPTH;
	t->pending.n = 0;
	for (int i = 0; i < TILE_BLOCKS; i++) {
		t->plane_x[i] = convert_float16(BLOCK_X + BLOCK * i) + clip_from_origin(t->view, t->x, t->view->sample[0]);
		t->plane_y[i] = row - convert_float16(BLOCK_Y + BLOCK * i);
	}
	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x++) {
			struct camera_pack *p = &t->packs[y][x];

			p->order = p->instance = p->primitive = SCENE_NONE;
			p->b1 = p->b2 = 0;
			/* Where pixels do not count nothing is farther than what is there. */
			p->depth = select((packf)(0), (packf)(NO_DEPTH),
			                  (BLOCK_X + BLOCK * x >= t->open.x0) & (BLOCK_X + BLOCK * x < t->open.x1) &
			                  (BLOCK_Y + BLOCK * y >= t->open.y0) & (BLOCK_Y + BLOCK * y < t->open.y1));
			p->steps = NO_DEPTH * 16777216.0f;
		}
}

KERNEL_OF(float16) void camera_packet(KERNEL_ARGUMENTS(camera_packet))
{
	__global const struct view *view = &views[view_index];
	__global const float *viewport = view->viewport;
	const struct camera_rectangle r = rectangle;
	const uint item = (uint)get_global_id(0);
	struct tile t;
	int is_done;

	if (item >= camera_packet_items(r))
		return;
	t.view = view;
	t.instances = instances;
	t.nodes = nodes;
	t.faces = triangles;
	t.window = window;
	t.clip = clip;
	t.fragments = fragments;
	t.width = width;
	t.height = height;
	t.mode = mode;
	t.first_pixel = first_pixel;
	t.x = camera_packet_x(r, item);
	t.y = camera_packet_y(r, item);
	t.open.x0 = max(r.x0 - t.x, 0);
	t.open.y0 = max(r.y0 - t.y, 0);
	t.open.x1 = min(r.x1 - t.x, CAMERA_TILE);
	t.open.y1 = min(r.y1 - t.y, CAMERA_TILE);
	clear_tile(&t);
	t.listed.is_used = 0;
	if (mode == CAMERA_COLUMN)
		clear_columns(&t, after);
	is_done = t.listed.is_used && t.listed.least == SCENE_NONE;
	if (view->tlas_count && !is_done) {
		open_pixels(&t, fmax((float)r.x0, viewport[0]), fmax((float)r.y0, viewport[1]),
		            fmin((float)r.x1, viewport[0] + viewport[2]), fmin((float)r.y1, viewport[1] + viewport[3]));
		tile_walk_top(&t, top + view->tlas_first, instance_list);
		if (t.listed.is_used)
			draw_listed(&t);
	}
	open_pixels(&t, (float)r.x0, (float)r.y0, (float)r.x1, (float)r.y1);
	for (uint i = 0; i < view->screen_count && !is_done; i++)
		walk_screen(&t, view->screen_first + i);
	if (t.listed.is_used)
		draw_listed(&t);
	store_tile(&t, counts);
}
