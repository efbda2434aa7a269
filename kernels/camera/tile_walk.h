/*
 * Finds the triangles that a tile sees: its rays traverse the trees as one frustum against eight boxes at once, nearest
 * child first. The farthest of the tile's nearest fragments shortens the frustum. OpenCL C only.
 */
#pragma once

#include "kernels/camera/tile_list.h"

/* Queue a block of an instance's faces, or list it. The first sixteen queued are drawn once there are enough. place:
 * index among all blocks */
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

/* Sample position, in pixels from the pixels' centres. */
static inline float tile_sample(const struct tile *t, int axis)
{
	return (float)t->view->sample[axis] * 0.00390625f;
}

/*
 * The tile's frustum in the space that `m` (3 rows of 4; NULL: eye space) maps to eye space. With clip coordinates x y
 * z w, a pixel centre between X0 and X1 satisfies X0 w <= x <= X1 w, and likewise for y; all are linear in the point.
 */
static inline struct frustum tile_frustum(const struct tile *t, __global const float *m, struct vec3 extent)
{
	__global const struct view *view = t->view;
	__global const float *p = view->projection;
	const float scale_x = 2.0f / view->viewport[2], scale_y = 2.0f / view->viewport[3];
	const float left = (float)t->x + tile_sample(t, 0) - view->viewport[0];
	const float low = (float)t->y + tile_sample(t, 1) - view->viewport[1];
	/* A hundredth of a pixel wider, as snapping moves edges by 1/512. */
	const float x0 = (left + 0.49f) * scale_x - 1.0f, x1 = (left + CAMERA_TILE - 0.49f) * scale_x - 1.0f;
	const float y0 = (low + 0.49f) * scale_y - 1.0f, y1 = (low + CAMERA_TILE - 0.49f) * scale_y - 1.0f;
	/* Lanes: left, right, bottom, top, near, far, in front of the viewer, and one that every box passes. */
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

/* A node, or a leaf of `count` blocks of faces, and how far it reaches in front of the far plane. */
struct tile_entry {
	float reach;
	uint child, count;
};

/* Push the children of a node that the tile may see. The one that reaches farthest in front of the far plane is popped
 * first. nodes, faces: the instance's. */
static inline uint tile_push_children(const struct frustum8 *f, __global const struct node8 *nodes,
                                      __global const struct face8 *faces, uint index, struct tile_entry *stack,
                                      uint depth)
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
	const struct vec3 extent = v3(fabs(instance->centre[0]) + r, fabs(instance->centre[1]) + r,
	                              fabs(instance->centre[2]) + r);

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
			/* A leaf's faces are prefetched one leaf before they are added. */
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

		/* Nearest first: instances are handled at once; of two inner children, the farther one is pushed first. */
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

/* Geometry in window space is tested at the sample positions, as points. */
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

/* Open the tile's pixels between x0 and x1, y0 and y1: they accept fragments from now on. */
WIDE_VECTORS static inline void open_pixels(struct tile *t, float x0, float y0, float x1, float y1)
{
	for (int i = 0; i < TILE_BLOCKS; i++) {
		const packf px = convert_float16(t->x + BLOCK * i + BLOCK_X) + 0.5f + tile_sample(t, 0);
		const packf py = convert_float16(t->y + BLOCK * i + BLOCK_Y) + 0.5f + tile_sample(t, 1);

		t->off_x[i] = ~((px >= x0) & (px < x1));
		t->off_y[i] = ~((py >= y0) & (py < y1));
	}
}

/* --- the whole tile ---------------------------------------------------------------------------------------------- */

WIDE_VECTORS static inline void clear_tile(struct tile *t)
{
	const float row = clip_from_origin(t->view, (int)t->height - 1 - t->y, -t->view->sample[1]);

	t->is_drawn = t->changed = 0;
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
			/* Pixels outside the rectangle never limit the farthest depth. */
			p->depth = select((packf)(0), (packf)(NO_DEPTH),
			                  (BLOCK_X + BLOCK * x >= t->open.x0) & (BLOCK_X + BLOCK * x < t->open.x1) &
			                  (BLOCK_Y + BLOCK * y >= t->open.y0) & (BLOCK_Y + BLOCK * y < t->open.y1));
			p->steps = NO_DEPTH * 16777216.0f;
		}
}

/* Draw what the view shows in the tile at t->x, t->y. a: camera_packet's arguments */
static inline void tile_draw(const struct camera_packet_arguments *a, struct tile *t)
{
	__global const struct view *view = &a->pass.views[a->pass.view_index];
	__global const float *viewport = view->viewport;
	const struct camera_rectangle r = a->pass.rectangle;
	int is_done;

	t->view = view;
	t->instances = a->instances;
	t->nodes = a->nodes;
	t->faces = a->triangles;
	t->window = a->pass.window;
	t->clip = a->pass.clip;
	t->fragments = a->pass.fragments;
	t->width = a->pass.width;
	t->height = a->pass.height;
	t->mode = a->pass.mode;
	t->first_pixel = a->pass.first_pixel;
	t->open.x0 = max(r.x0 - t->x, 0);
	t->open.y0 = max(r.y0 - t->y, 0);
	t->open.x1 = min(r.x1 - t->x, CAMERA_TILE);
	t->open.y1 = min(r.y1 - t->y, CAMERA_TILE);
	clear_tile(t);
	t->listed.is_used = 0;
	if (t->mode == CAMERA_COLUMN)
		clear_columns(t, a->pass.after);
	is_done = t->listed.is_used && t->listed.least == SCENE_NONE;
	if (view->tlas_count && !is_done) {
		open_pixels(t, fmax((float)r.x0, viewport[0]), fmax((float)r.y0, viewport[1]),
		            fmin((float)r.x1, viewport[0] + viewport[2]), fmin((float)r.y1, viewport[1] + viewport[3]));
		tile_walk_top(t, a->top + view->tlas_first, a->instance_list);
		if (t->listed.is_used)
			draw_listed(t);
	}
	open_pixels(t, (float)r.x0, (float)r.y0, (float)r.x1, (float)r.y1);
	for (uint i = 0; i < view->screen_count && !is_done; i++)
		walk_screen(t, view->screen_first + i);
	if (t->listed.is_used)
		draw_listed(t);
}
