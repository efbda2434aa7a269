/*
 * camera_packet: a tile of 16 x 16 pixels a work item. See kernels/camera.h.
 *
 * The tile's rays go through the trees as one frustum, nearest child first, cut off behind the farthest of the tile's
 * nearest fragments. A leaf's triangles are decided row by row, sixteen pixels at once.
 */
#include "kernels/camera.h"
#include "kernels/coverage.h"
#include "kernels/frustum.h"

/* The far plane's lane in a tile's frustum. */
#define FAR_PLANE 5

/* What the pixels of a row hold. NEAREST: the nearest fragment; steps is all ones where there is none. */
struct row {
	packi inside;  /* pixels of the view's rectangle */
	packi on;      /* of these, pixels that take fragments now */
	packi counts;  /* COLUMN: fragments so far */
	packu steps, order, instance, primitive;
	packf b1, b2, depth;
};

struct tile {
	__global const struct view *view;
	__global const struct instance *instances;
	__global const struct node2 *nodes;
	__global const struct triangle *triangles;
	__global const struct window_vertex *window;
	__global const float *clip;
	__global const uint *after;
	__global struct fragment *fragments;
	uint width, height, mode;
	int x, y;      /* the first pixel */
	int changed;   /* a nearest fragment was replaced since z_far was set */
	float z_far;   /* in normalised device coordinates: nothing behind it matters */
	struct row rows[CAMERA_TILE_HEIGHT];
};

/* A candidate: its numbers. */
struct candidate {
	uint order, instance, primitive;
};

/* --- fragments --- */

WIDE_VECTORS static inline void keep_nearest(struct tile *t, int y, packi covered, packf b1, packf b2, packf depth, struct candidate c)
{
	struct row *row = &t->rows[y];
	const packu steps = convert_uint16(rint(depth * 16777215.0f));
	const packi before = t->mode == CAMERA_NEAREST_LESS ? (packu)(c.order) < row->order : (packu)(c.order) > row->order;
	const packi better = covered & ((steps < row->steps) | ((steps == row->steps) & before));

	if (!any_pack(better))
		return;
	t->changed = 1;
	row->order = select(row->order, (packu)(c.order), better);
	row->instance = select(row->instance, (packu)(c.instance), better);
	row->primitive = select(row->primitive, (packu)(c.primitive), better);
	row->steps = select(row->steps, steps, better);
	row->b1 = select(row->b1, b1, better);
	row->b2 = select(row->b2, b2, better);
	row->depth = select(row->depth, depth, better);
}

static inline void keep_in_columns(struct tile *t, int y, packi covered, packf b1, packf b2, packf depth, struct candidate c)
{
	for (int lane = 0; lane < CAMERA_TILE_WIDTH; lane++) {
		const size_t pixel = (size_t)(t->y + y) * t->width + (size_t)(t->x + lane);
		__global struct fragment *column = t->fragments + pixel * CAMERA_COLUMN_MAX;
		int *count = (int *)&t->rows[y].counts + lane, place = *count;

		if (!((const int *)&covered)[lane] || c.order < t->after[pixel])
			continue;
		while (place > 0 && column[place - 1].order > c.order)
			place--;
		/* A triangle may lie in several leaves. */
		if (place == CAMERA_COLUMN_MAX || (place > 0 && column[place - 1].order == c.order))
			continue;
		if (*count < CAMERA_COLUMN_MAX)
			++*count;
		for (int i = *count - 1; i > place; i--)
			column[i] = column[i - 1];
		column[place].order = c.order;
		column[place].instance = c.instance;
		column[place].primitive = c.primitive;
		column[place].b1 = ((const float *)&b1)[lane];
		column[place].b2 = ((const float *)&b2)[lane];
		column[place].depth = ((const float *)&depth)[lane];
	}
}

static inline void keep(struct tile *t, int y, packi covered, packf b1, packf b2, packf depth, struct candidate c)
{
	if (t->mode == CAMERA_COLUMN)
		keep_in_columns(t, y, covered, b1, b2, depth, c);
	else
		keep_nearest(t, y, covered, b1, b2, depth, c);
}

/* Move the far plane up to the farthest of the tile's nearest fragments. */
WIDE_VECTORS static inline void shorten(struct tile *t)
{
	const float near = t->view->depth_range[0], range = t->view->depth_range[1] - near;
	packu steps = 0;
	uint8 eight;
	uint4 four;
	uint2 two;
	uint farthest;

	t->changed = 0;
	if (!(range > 0))
		return; /* the nearest depth is not the first along the ray */
	for (int y = 0; y < CAMERA_TILE_HEIGHT; y++)
		steps = max(steps, t->rows[y].steps & as_uint16(t->rows[y].on));
	eight = max(steps.lo, steps.hi);
	four = max(eight.lo, eight.hi);
	two = max(four.lo, four.hi);
	farthest = max(two.lo, two.hi);
	/* A step more, for equal depths, and what rounding may do. */
	if (farthest < 0x1000000u)
		t->z_far = fmin(2.0f * (((float)farthest * (1.0f / 16777216.0f) - near) / range + 4e-7f) - 1.0f, 1.0f);
}

/* --- coverage --- */

/*
 * One edge a -> b of a triangle that turns counter-clockwise once exchanged so: the edge function at a pixel centre and
 * its steps to the right and up. 64 bits hold the function exactly; of its whole part, which is clamped to where the
 * steps inside a tile cannot change its sign, 32 bits do.
 */
struct tile_edge {
	long value;         /* exact, 1/65536 square pixel */
	int step_x, step_y; /* 1/256 square pixel a pixel */
	int whole;          /* (value - (1 where the edge itself is outside)) / 256, rounded down and clamped */
};

static inline struct tile_edge tile_edge(struct window_vertex a, struct window_vertex b, struct clip_spot at)
{
	const int dx = b.x - a.x, dy = b.y - a.y;
	struct tile_edge e;

	e.value = (long)dx * (at.y - a.y) - (long)dy * (at.x - a.x);
	e.step_x = -dy;
	e.step_y = dx;
	e.whole = (int)clamp((e.value - !(dy < 0 || (dy == 0 && dx > 0))) >> 8, -(1l << 30), 1l << 30);
	return e;
}

/* In lanes: not negative where the centre is on the inner side, on row y after the edge's own. */
static inline packi edge_inside(struct tile_edge e, int y)
{
	return (e.whole + y * e.step_y) + PACK_LANES * e.step_x;
}

/*
 * The function's value in all lanes, rounded once. `small`: inside the triangle it fits into 32 bits; what overflows in
 * other lanes, or on the way, does not matter.
 */
static inline packf edge_values(struct tile_edge e, int y, int small)
{
	if (small)
		return convert_float16(as_int16((uint)e.value + (uint)(y * e.step_y) * 256u + as_uint16(PACK_LANES * e.step_x) * 256u));
	return convert_float16((long16)(e.value + (long)y * e.step_y * 256) + convert_long16(PACK_LANES * e.step_x) * 256);
}

/*
 * All vertices have a place in the window. corner: NULL, or the three corners where the triangle is part of one that leaves the
 * view volume; the fragments' weights are those of the whole then. clip: else, where the vertices are in clip space.
 */
WIDE_VECTORS static inline void try_placed(struct tile *t, uint flags, struct window_vertex v0, struct window_vertex v1,
                       struct window_vertex v2, const struct clip_corner *const *corner, const struct vec4 *clip,
                       struct candidate c)
{
	/* Rows and columns of pixels whose places (centres, or samples) the triangle's box holds. */
	const int in_x = 128 + t->view->sample[0], in_y = 128 + t->view->sample[1];
	const int x_first = (min(min(v0.x, v1.x), v2.x) + 255 - in_x) >> 8, x_last = (max(max(v0.x, v1.x), v2.x) - in_x) >> 8;
	const int y_first = max((min(min(v0.y, v1.y), v2.y) + 255 - in_y) >> 8, t->y);
	const int y_last = min((max(max(v0.y, v1.y), v2.y) - in_y) >> 8, t->y + CAMERA_TILE_HEIGHT - 1);
	const struct clip_spot at = clip_spot(t->view, t->x, y_first);
	const long area = (long)(v1.x - v0.x) * (v2.y - v0.y) - (long)(v2.x - v0.x) * (v1.y - v0.y);
	const int clockwise = area < 0, small = area < (1l << 28) && area > -(1l << 28);
	const float z[3] = { v0.z, v1.z, v2.z };
	struct tile_edge e0, e1, e2;
	struct clip_plane plane;
	int exact = -1; /* not known yet */
	float inverse;

	if (y_first > y_last || x_first > x_last || x_last < t->x || x_first >= t->x + CAMERA_TILE_WIDTH || area == 0 ||
	    coverage_culled(flags, !clockwise))
		return;
	/* Edge i is the one across from vertex i; turned round where the triangle runs clockwise. */
	e0 = clockwise ? tile_edge(v2, v1, at) : tile_edge(v1, v2, at);
	e1 = clockwise ? tile_edge(v0, v2, at) : tile_edge(v2, v0, at);
	e2 = clockwise ? tile_edge(v1, v0, at) : tile_edge(v0, v1, at);
	inverse = 1.0f / (float)abs_diff(area, 0l);
	for (int y = 0; y <= y_last - y_first; y++) {
		const int row = y_first - t->y + y;
		const packi covered = t->rows[row].on & ((edge_inside(e0, y) | edge_inside(e1, y) | edge_inside(e2, y)) >= 0);
		packf b1, b2, depth;

		if (!any_pack(covered))
			continue;
		b1 = edge_values(e1, y, small) * inverse;
		b2 = edge_values(e2, y, small) * inverse;
		if (exact < 0)
			exact = t->mode != CAMERA_COLUMN && clip_depth_plane(t->view, (float)t->height, corner, clip, z, &plane);
		if (exact)
			depth = fma((packf)(plane.along_y),
			            (packf)(clip_from_origin(t->view, (int)t->height - 1 - (t->y + row), -t->view->sample[1])),
			            fma((packf)(plane.along_x),
			                convert_float16(PACK_LANES) + clip_from_origin(t->view, t->x, t->view->sample[0]),
			                (packf)(plane.origin)));
		else
			depth = v0.z + (b1 * (v1.z - v0.z) + b2 * (v2.z - v0.z));
		depth = select(depth, (packf)(1), depth > 1.0f);
		depth = select(depth, (packf)(0), depth < 0.0f);
		if (corner) {
			const packf p0 = (1.0f - b1 - b2) * v0.w_inv, p1 = b1 * v1.w_inv, p2 = b2 * v2.w_inv, sum = p0 + p1 + p2;

			b1 = (p0 * corner[0]->b1 + p1 * corner[1]->b1 + p2 * corner[2]->b1) / sum;
			b2 = (p0 * corner[0]->b2 + p1 * corner[1]->b2 + p2 * corner[2]->b2) / sum;
		}
		keep(t, row, covered, b1, b2, depth, c);
	}
}

/* A vertex lies outside of the view volume: what is left of the triangle is asked. i0, i1, i2: places in clip. */
static inline void try_clipped(struct tile *t, uint flags, uint i0, uint i1, uint i2, struct candidate c)
{
	struct clip_polygon polygon;

	clip_triangle(t->view, (float)t->height, v4_load(t->clip + 4 * i0), v4_load(t->clip + 4 * i1), v4_load(t->clip + 4 * i2),
	              &polygon);
	for (uint k = 2; k < polygon.n; k++) {
		const struct clip_corner *corner[3] = { &polygon.corner[k - 1], &polygon.corner[k], &polygon.corner[0] };

		try_placed(t, flags, corner[0]->window, corner[1]->window, corner[2]->window, corner, 0, c);
	}
}

static inline void try_triangle(struct tile *t, uint index, __global const struct instance *instance,
                         __global const struct triangle *triangle)
{
	const uint first = instance->vertex_first, primitive = triangle->primitive;
	const uint i0 = first + triangle->vertex[0], i1 = first + triangle->vertex[1], i2 = first + triangle->vertex[2];
	const struct window_vertex v0 = t->window[i0], v1 = t->window[i1], v2 = t->window[i2];
	struct candidate c;

	c.order = instance->primitive_first + primitive;
	c.instance = index;
	c.primitive = primitive;
	if (v0.w_inv > 0 && v1.w_inv > 0 && v2.w_inv > 0) {
		const struct vec4 clip[3] = { v4_load(t->clip + 4 * i0), v4_load(t->clip + 4 * i1), v4_load(t->clip + 4 * i2) };

		try_placed(t, instance->flags, v0, v1, v2, 0, clip, c);
	} else {
		c.primitive |= FRAGMENT_PERSPECTIVE;
		try_clipped(t, instance->flags, i0, i1, i2, c);
	}
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
static inline struct frustum tile_frustum(const struct tile *t, __global const float *m, __global const struct node2 *root)
{
	__global const struct view *view = t->view;
	__global const float *p = view->projection;
	const float scale_x = 2.0f / view->viewport[2], scale_y = 2.0f / view->viewport[3];
	const float left = (float)t->x + tile_sample(t, 0) - view->viewport[0];
	const float low = (float)t->y + tile_sample(t, 1) - view->viewport[1];
	/* A pixel's hundredth more: snapping moves edges by 1/512. */
	const float x0 = (left + 0.49f) * scale_x - 1.0f, x1 = (left + CAMERA_TILE_WIDTH - 0.49f) * scale_x - 1.0f;
	const float y0 = (low + 0.49f) * scale_y - 1.0f, y1 = (low + CAMERA_TILE_HEIGHT - 0.49f) * scale_y - 1.0f;
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
		return frustum_make(e[0], e[1], e[2], e[3], abs_e[0], abs_e[1], abs_e[2], abs_e[3], root);
	for (int i = 0; i < 4; i++) {
		o[i] = e[0] * m[i] + e[1] * m[4 + i] + e[2] * m[8 + i] + (i == 3 ? e[3] : (float8)(0));
		abs_o[i] = abs_e[0] * fabs(m[i]) + abs_e[1] * fabs(m[4 + i]) + abs_e[2] * fabs(m[8 + i]) +
		           (i == 3 ? abs_e[3] : (float8)(0));
	}
	return frustum_make(o[0], o[1], o[2], o[3], abs_o[0], abs_o[1], abs_o[2], abs_o[3], root);
}

static inline void walk_blas(struct tile *t, uint index)
{
	__global const struct instance *instance = &t->instances[index];
	__global const struct node2 *nodes = t->nodes + instance->node2_first;
	__global const struct triangle *triangles = t->triangles + instance->triangle_first;
	struct frustum f = tile_frustum(t, instance->eye_from_obj, nodes);
	uint2 stack[BVH_MAX_DEPTH + 1]; /* child, count */
	uint depth = 0;
	uint2 entry = (uint2)(0, 0);

	for (;;) {
		if (entry.y == 0) {
			__global const struct node2 *node = &nodes[entry.x];
			const float8 reach0 = frustum_reach(&f, node, 0), reach1 = frustum_reach(&f, node, 1);
			const int meets0 = frustum_meets(reach0), meets1 = frustum_meets(reach1) && side_exists(node, 1);
			const uint2 side0 = (uint2)(node->child[0], node->count[0]), side1 = (uint2)(node->child[1], node->count[1]);

			if (meets0 && meets1) {
				/* What reaches farther before the far plane goes first. */
				const int first = reach1.s5 > reach0.s5;

				stack[depth++] = first ? side0 : side1;
				entry = first ? side1 : side0;
				continue;
			}
			if (meets0 || meets1) {
				entry = meets0 ? side0 : side1;
				continue;
			}
		} else {
			for (uint i = 0; i < entry.y; i++)
				try_triangle(t, index, instance, &triangles[entry.x + i]);
			if (t->changed) {
				const float before = t->z_far;

				shorten(t);
				if (t->z_far < before)
					f = tile_frustum(t, instance->eye_from_obj, nodes);
			}
		}
		if (depth == 0)
			return;
		entry = stack[--depth];
	}
}

static inline void walk_top(struct tile *t, __global const struct node2 *top, __global const uint *instance_list)
{
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &top[stack[--depth]];
		const struct frustum f = tile_frustum(t, 0, top);
		const int first = frustum_reach(&f, node, 1).s5 > frustum_reach(&f, node, 0).s5;

		/* Nearest first: instances at once, of inner children the farther one is pushed before the nearer. */
		for (int i = 0; i < 2; i++) {
			const uint side = first ^ i;

			if (node->count[side] == 0 || !frustum_meets(frustum_reach(&f, node, side)))
				continue;
			for (uint k = 0; k < node->count[side]; k++)
				walk_blas(t, instance_list[node->child[side] + k]);
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
	__global const struct node2 *nodes = t->nodes + instance->node2_first;
	const float left = (float)t->x + tile_sample(t, 0), low = (float)t->y + tile_sample(t, 1), pad = instance->pad;
	const float x0 = left + 0.5f - pad, x1 = left + CAMERA_TILE_WIDTH - 0.5f + pad;
	const float y0 = low + 0.5f - pad, y1 = low + CAMERA_TILE_HEIGHT - 0.5f + pad;
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &nodes[stack[--depth]];

		for (uint side = 0; side < 2; side++) {
			if (!(x1 >= node->lo[side][0] && x0 <= node->hi[side][0] && y1 >= node->lo[side][1] && y0 <= node->hi[side][1]))
				continue;
			if (node->count[side] == 0)
				stack[depth++] = node->child[side];
			for (uint i = 0; i < node->count[side]; i++)
				try_triangle(t, index, instance, &t->triangles[instance->triangle_first + node->child[side] + i]);
		}
	}
}

static inline void store_tile(const struct tile *t, __global uint *counts)
{
	for (int y = 0; y < CAMERA_TILE_HEIGHT; y++)
		for (int lane = 0; lane < CAMERA_TILE_WIDTH; lane++) {
			const struct row *row = &t->rows[y];
			const size_t pixel = (size_t)(t->y + y) * t->width + (size_t)(t->x + lane);
			struct fragment f;

			if (!((const int *)&row->inside)[lane])
				continue;
			if (t->mode == CAMERA_COLUMN) {
				counts[pixel] = (uint)((const int *)&row->counts)[lane];
				continue;
			}
			f.order = ((const uint *)&row->order)[lane];
			f.instance = ((const uint *)&row->instance)[lane];
			f.primitive = ((const uint *)&row->primitive)[lane];
			f.b1 = ((const float *)&row->b1)[lane];
			f.b2 = ((const float *)&row->b2)[lane];
			f.depth = ((const float *)&row->depth)[lane];
			t->fragments[pixel] = f;
			counts[pixel] = f.order != SCENE_NONE;
		}
}

__kernel void camera_packet(uint view_index, __global const struct view *views, uint width, uint height, uint mode,
                            __global const struct instance *instances, __global const struct node2 *top,
                            __global const uint *instance_list, __global const struct node2 *nodes,
                            __global const struct triangle *triangles, __global const struct window_vertex *window,
                            __global const float *clip, __global const uint *after,
                            __global struct fragment *fragments, __global uint *counts)
{
	__global const struct view *view = &views[view_index];
	__global const float *viewport = view->viewport;
	const struct camera_rectangle r = camera_rectangle(view->scissor[0], view->scissor[1], view->scissor[2],
	                                                   view->scissor[3], width, height);
	const uint item = (uint)get_global_id(0), columns = (uint)(r.x1 - r.x0 + CAMERA_TILE_WIDTH - 1) / CAMERA_TILE_WIDTH;
	struct tile t;

	if (item >= camera_packet_items(r))
		return;
	t.view = view;
	t.instances = instances;
	t.nodes = nodes;
	t.triangles = triangles;
	t.window = window;
	t.clip = clip;
	t.after = after;
	t.fragments = fragments;
	t.width = width;
	t.height = height;
	t.mode = mode;
	t.x = r.x0 + (int)(item % columns) * CAMERA_TILE_WIDTH;
	t.y = r.y0 + (int)(item / columns) * CAMERA_TILE_HEIGHT;
	t.changed = 0;
	t.z_far = 1;
	for (int y = 0; y < CAMERA_TILE_HEIGHT; y++) {
		struct row *row = &t.rows[y];
		const packf px = convert_float16(t.x + PACK_LANES) + 0.5f + tile_sample(&t, 0);
		const float py = (float)(t.y + y) + 0.5f + tile_sample(&t, 1);

		row->inside = (t.x + PACK_LANES < r.x1) & (packi)(t.y + y < r.y1 ? -1 : 0);
		row->on = row->inside & (px >= viewport[0]) & (px < viewport[0] + viewport[2]) &
		          (packi)(py >= viewport[1] && py < viewport[1] + viewport[3] ? -1 : 0);
		row->counts = 0;
		row->steps = row->order = row->instance = row->primitive = SCENE_NONE;
		row->b1 = row->b2 = 0;
		row->depth = 1;
	}
	if (view->tlas_count)
		walk_top(&t, top + view->tlas_first, instance_list);
	for (int y = 0; y < CAMERA_TILE_HEIGHT; y++)
		t.rows[y].on = t.rows[y].inside;
	for (uint i = 0; i < view->screen_count; i++)
		walk_screen(&t, view->screen_first + i);
	store_tile(&t, counts);
}
