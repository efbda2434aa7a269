/*
 * camera_packet: eight pixels, 4 x 2, a work item. See kernels/camera.h.
 */
#include "kernels/camera.h"
#include "kernels/packet.h"
#include "kernels/coverage.h"

/* A block of pixels on its way. Lane i is pixel x + i % 4, y + i / 4. */
struct block {
	__global const struct view *view;
	__global const struct instance *instances;
	__global const struct node2 *nodes;
	__global const struct triangle *triangles;
	__global const struct window_vertex *window;
	__global const float *clip;
	__global const uint *after;
	__global struct fragment *fragments;
	uint width, mode;
	int x, y;
	int8 inside;   /* lanes that are pixels of the view's rectangle */
	int8 on;       /* of these, lanes that take fragments now */
	int8 counts;   /* fragments so far */
	struct packet eye;
	float8 near_w, far_w, d_scale;
	/* NEAREST */
	uint8 order, instance, primitive, steps;
	float8 b1, b2, depth;
};

/* A candidate's fragment, per lane. */
struct covered {
	int8 lanes;
	float8 b1, b2, depth;
};

#define LANE_X ((int8)(0, 1, 2, 3, 0, 1, 2, 3))
#define LANE_Y ((int8)(0, 0, 0, 0, 1, 1, 1, 1))

/* --- fragments --- */

inline void shorten(struct block *b, int8 lanes)
{
	const float near = b->view->depth_range[0], range = b->view->depth_range[1] - near;
	const float8 u = (b->depth - near) / range + 4e-7f;
	const float8 w = (1.0f - u) * b->near_w + u * b->far_w - 1e-6f * b->near_w;

	if (!(range > 0))
		return; /* the nearest depth is not the first along the ray */
	lanes &= w * b->near_w > 0;
	b->eye.t_max = select(b->eye.t_max, fmin(b->eye.t_max, u * b->d_scale / (b->near_w * w)), lanes);
}

inline void keep_nearest(struct block *b, const struct covered *c, uint order, uint instance, uint primitive)
{
	const uint8 steps = convert_uint8(c->depth * 16777215.0f + 0.5f);
	const int8 before = b->mode == CAMERA_NEAREST_LESS ? (uint8)(order) < b->order : (uint8)(order) > b->order;
	const int8 better = c->lanes & ((b->counts == 0) | (steps < b->steps) | ((steps == b->steps) & before));

	if (!any_lane(better))
		return;
	b->counts = select(b->counts, (int8)(1), better);
	b->order = select(b->order, (uint8)(order), better);
	b->instance = select(b->instance, (uint8)(instance), better);
	b->primitive = select(b->primitive, (uint8)(primitive), better);
	b->steps = select(b->steps, steps, better);
	b->b1 = select(b->b1, c->b1, better);
	b->b2 = select(b->b2, c->b2, better);
	b->depth = select(b->depth, c->depth, better);
	shorten(b, better);
}

inline void keep_in_columns(struct block *b, const struct covered *c, uint order, uint instance, uint primitive)
{
	for (int lane = 0; lane < 8; lane++) {
		const uint pixel = (uint)(b->y + lane / 4) * b->width + (uint)(b->x + lane % 4);
		__global struct fragment *column = b->fragments + (size_t)pixel * CAMERA_COLUMN_MAX;
		int *count = (int *)&b->counts + lane, place = *count;

		if (!((const int *)&c->lanes)[lane] || order < b->after[pixel])
			continue;
		while (place > 0 && column[place - 1].order > order)
			place--;
		if (place == CAMERA_COLUMN_MAX)
			continue;
		if (*count < CAMERA_COLUMN_MAX)
			++*count;
		for (int i = *count - 1; i > place; i--)
			column[i] = column[i - 1];
		column[place].order = order;
		column[place].instance = instance;
		column[place].primitive = primitive;
		column[place].b1 = ((const float *)&c->b1)[lane];
		column[place].b2 = ((const float *)&c->b2)[lane];
		column[place].depth = ((const float *)&c->depth)[lane];
	}
}

/* --- coverage --- */

/*
 * One edge a -> b of a triangle that turns counter-clockwise once exchanged so: the edge function at the first pixel
 * centre and its steps to the right and up, in whole pixels' units of 1/256 (the fraction is in `low`). 64 bits hold
 * the function exactly; its whole part is clamped to where the few steps inside a block cannot change its sign.
 */
struct block_edge {
	long value;  /* exact, 1/65536 square pixel, at the first centre */
	int step_x, step_y; /* 1/256 square pixel a pixel */
	int whole;   /* (value - (1 where the edge itself is outside)) / 256, rounded down and clamped */
};

inline struct block_edge block_edge(struct window_vertex a, struct window_vertex b, int x, int y)
{
	const int dx = b.x - a.x, dy = b.y - a.y;
	struct block_edge e;

	e.value = (long)dx * ((long)y * 256 + 128 - a.y) - (long)dy * ((long)x * 256 + 128 - a.x);
	e.step_x = -dy;
	e.step_y = dx;
	e.whole = (int)clamp((e.value - !(dy < 0 || (dy == 0 && dx > 0))) >> 8, -(1l << 30), 1l << 30);
	return e;
}

inline int8 inside_edge(struct block_edge e)
{
	return e.whole + (LANE_X * e.step_x + LANE_Y * e.step_y) >= 0;
}

/*
 * The function's value in all lanes, rounded once. `small`: inside the triangle it fits into 32 bits; what overflows in
 * other lanes, or on the way, does not matter.
 */
inline float8 edge_values(struct block_edge e, int small)
{
	if (small)
		return convert_float8(as_int8((uint)e.value + as_uint8(LANE_X * e.step_x + LANE_Y * e.step_y) * 256u));
	return convert_float8((long8)(e.value) + convert_long8(LANE_X * e.step_x + LANE_Y * e.step_y) * 256);
}

/* All vertices have a place in the window. */
inline struct covered cover_placed(const struct block *b, uint flags, struct window_vertex v0, struct window_vertex v1,
                                   struct window_vertex v2)
{
	const long area = (long)(v1.x - v0.x) * (v2.y - v0.y) - (long)(v2.x - v0.x) * (v1.y - v0.y);
	const int clockwise = area < 0;
	struct block_edge e0, e1, e2;
	struct covered c;
	float inverse;
	int small;

	c.lanes = 0;
	if (area == 0 || coverage_culled(flags, !clockwise))
		return c;
	/* Edge i is the one across from vertex i; turned round where the triangle runs clockwise. */
	e0 = clockwise ? block_edge(v2, v1, b->x, b->y) : block_edge(v1, v2, b->x, b->y);
	e1 = clockwise ? block_edge(v0, v2, b->x, b->y) : block_edge(v2, v0, b->x, b->y);
	e2 = clockwise ? block_edge(v1, v0, b->x, b->y) : block_edge(v0, v1, b->x, b->y);
	c.lanes = b->on & inside_edge(e0) & inside_edge(e1) & inside_edge(e2);
	if (!any_lane(c.lanes))
		return c;
	inverse = 1.0f / (float)abs_diff(area, 0l);
	small = area < (1l << 28) && area > -(1l << 28);
	c.b1 = edge_values(e1, small) * inverse;
	c.b2 = edge_values(e2, small) * inverse;
	c.depth = v0.z + (c.b1 * (v1.z - v0.z) + c.b2 * (v2.z - v0.z));
	c.depth = fmax(fmin(c.depth, 1.0f), 0.0f);
	return c;
}

/* A vertex has none: pixel by pixel, there are few of these triangles. */
inline struct covered cover_clipped(const struct block *b, uint flags, uint i0, uint i1, uint i2)
{
	struct covered c;

	c.lanes = 0;
	c.b1 = c.b2 = c.depth = 0;
	for (int lane = 0; lane < 8; lane++) {
		float b1, b2, depth;

		if (!((const int *)&b->on)[lane] ||
		    !coverage_clipped(b->view, b->window, b->clip, i0, i1, i2, flags, b->x + lane % 4, b->y + lane / 4, &b1, &b2,
		                      &depth))
			continue;
		((int *)&c.lanes)[lane] = -1;
		((float *)&c.b1)[lane] = b1;
		((float *)&c.b2)[lane] = b2;
		((float *)&c.depth)[lane] = depth;
	}
	return c;
}

inline void try_triangle(struct block *b, uint index, __global const struct instance *instance,
                         __global const struct triangle *triangle)
{
	const uint first = instance->vertex_first;
	const uint i0 = first + triangle->vertex[0], i1 = first + triangle->vertex[1], i2 = first + triangle->vertex[2];
	const struct window_vertex v0 = b->window[i0], v1 = b->window[i1], v2 = b->window[i2];
	const int placed = v0.w_inv > 0 && v1.w_inv > 0 && v2.w_inv > 0;
	const uint order = instance->primitive_first + triangle->primitive;
	uint primitive = triangle->primitive;
	struct covered c;

	if (placed) {
		c = cover_placed(b, instance->flags, v0, v1, v2);
	} else {
		c = cover_clipped(b, instance->flags, i0, i1, i2);
		primitive |= FRAGMENT_PERSPECTIVE;
	}
	if (!any_lane(c.lanes))
		return;
	if (b->mode == CAMERA_COLUMN)
		keep_in_columns(b, &c, order, index, primitive);
	else
		keep_nearest(b, &c, order, index, primitive);
}

/* --- traversal --- */

/* A packet of one octant through one instance's tree. `lanes`: those of the octant. */
inline void walk_blas(struct block *b, struct packet *p, int octant, int8 lanes, uint index)
{
	__global const struct instance *instance = &b->instances[index];
	__global const struct node2 *nodes = b->nodes + instance->node2_first;
	__global const struct triangle *triangles = b->triangles + instance->triangle_first;
	const struct planes planes = octant_planes(octant);
	struct packet_entry stack[BVH_MAX_DEPTH];
	uint depth = 0, child = 0, count = 0;

	b->on = lanes;
	for (;;) {
		if (count == 0) {
			__global const struct node2 *node = &nodes[child];
			__global const float *bounds = (__global const float *)node;
			const float8 enter0 = packet_enter(p, bounds, planes, 0), enter1 = packet_enter(p, bounds, planes, 1);
			const int8 hit0 = enter0 <= packet_leave(p, bounds, planes, 0);
			const int8 hit1 = enter1 <= packet_leave(p, bounds, planes, 1);
			const int any0 = any_lane(hit0), any1 = any_lane(hit1);

			if (any0 && any1) {
				const uint first = any_lane(hit1 & (enter1 < enter0));

				stack[depth].enter = first ? enter0 : enter1;
				stack[depth].child = node->child[!first];
				stack[depth].count = node->count[!first];
				depth++;
				child = node->child[first];
				count = node->count[first];
				continue;
			}
			if (any0 || any1) {
				child = node->child[any1];
				count = node->count[any1];
				continue;
			}
		} else {
			for (uint i = 0; i < count; i++)
				try_triangle(b, index, instance, &triangles[child + i]);
			p->t_max = select((float8)(-INFINITY), b->eye.t_max, lanes);
		}
		do {
			if (depth == 0)
				return;
			depth--;
		} while (!any_lane(stack[depth].enter <= p->t_max));
		child = stack[depth].child;
		count = stack[depth].count;
	}
}

inline void walk_instance(struct block *b, uint index)
{
	__global const struct instance *instance = &b->instances[index];
	int8 awake = b->eye.t_min <= b->eye.t_max, octants;
	struct packet p;

	packet_transform(&p, &b->eye, instance->obj_from_eye);
	packet_prepare(&p, instance->pad);
	p.t_min = b->eye.t_min;
	octants = packet_octants(&p);
	while (any_lane(awake)) {
		int octant;
		const int8 lanes = packet_next_octant(octants, &awake, &octant);

		p.t_max = select((float8)(-INFINITY), b->eye.t_max, lanes);
		walk_blas(b, &p, octant, lanes, index);
	}
}

inline void walk_top(struct block *b, __global const struct node2 *top, __global const uint *instance_list)
{
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &top[stack[--depth]];

		for (uint side = 0; side < 2; side++) {
			if (!any_lane(packet_meets_box(&b->eye, node, side)))
				continue;
			if (node->count[side] == 0)
				stack[depth++] = node->child[side];
			for (uint i = 0; i < node->count[side]; i++)
				walk_instance(b, instance_list[node->child[side] + i]);
		}
	}
}

/* Geometry in window space: pixel centres are points. */
inline void walk_screen(struct block *b, uint index)
{
	__global const struct instance *instance = &b->instances[index];
	__global const struct node2 *nodes = b->nodes + instance->node2_first;
	const float x0 = (float)b->x + 0.5f - instance->pad, x1 = (float)b->x + 3.5f + instance->pad;
	const float y0 = (float)b->y + 0.5f - instance->pad, y1 = (float)b->y + 1.5f + instance->pad;
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
				try_triangle(b, index, instance, &b->triangles[instance->triangle_first + node->child[side] + i]);
		}
	}
}

/* The pixels' rays; lanes outside of the viewport, and all where the projection has no inverse, sleep. */
inline void make_rays(struct block *b)
{
	__global const float *m = b->view->inverse, *viewport = b->view->viewport;
	const float8 px = convert_float8(b->x + LANE_X) + 0.5f, py = convert_float8(b->y + LANE_Y) + 0.5f;
	const float8 x = 2.0f * (px - viewport[0]) / viewport[2] - 1.0f;
	const float8 y = 2.0f * (py - viewport[1]) / viewport[3] - 1.0f;
	const float8 nx = m[0] * x + m[4] * y + (m[12] - m[8]), fx = m[0] * x + m[4] * y + (m[12] + m[8]);
	const float8 ny = m[1] * x + m[5] * y + (m[13] - m[9]), fy = m[1] * x + m[5] * y + (m[13] + m[9]);
	const float8 nz = m[2] * x + m[6] * y + (m[14] - m[10]), fz = m[2] * x + m[6] * y + (m[14] + m[10]);
	const float8 nw = m[3] * x + m[7] * y + (m[15] - m[11]), fw = m[3] * x + m[7] * y + (m[15] + m[11]);
	struct packet *p = &b->eye;
	int8 awake;

	p->ox = nx / nw, p->oy = ny / nw, p->oz = nz / nw;
	p->dx = fx * nw - nx * fw, p->dy = fy * nw - ny * fw, p->dz = fz * nw - nz * fw;
	b->d_scale = fmax(fabs(p->dx), fmax(fabs(p->dy), fabs(p->dz)));
	p->dx /= b->d_scale, p->dy /= b->d_scale, p->dz /= b->d_scale;
	b->near_w = nw, b->far_w = fw;
	awake = b->inside & (px >= viewport[0]) & (px < viewport[0] + viewport[2]) & (py >= viewport[1]) &
	        (py < viewport[1] + viewport[3]) & isfinite(p->ox + p->oy + p->oz) & isfinite(p->dx + p->dy + p->dz);
	p->ox = select((float8)(0), p->ox, awake), p->oy = select((float8)(0), p->oy, awake);
	p->oz = select((float8)(0), p->oz, awake), p->dx = select((float8)(1), p->dx, awake);
	p->dy = select((float8)(1), p->dy, awake), p->dz = select((float8)(1), p->dz, awake);
	p->t_min = 0;
	p->t_max = select((float8)(-INFINITY), (float8)(1e30f), awake);
	packet_prepare(p, 0);
}

inline void store_block(const struct block *b, __global uint *counts)
{
	for (int lane = 0; lane < 8; lane++) {
		const size_t pixel = (size_t)(b->y + lane / 4) * b->width + (size_t)(b->x + lane % 4);
		struct fragment f;

		if (!((const int *)&b->inside)[lane])
			continue;
		counts[pixel] = (uint)((const int *)&b->counts)[lane];
		if (b->mode == CAMERA_COLUMN)
			continue;
		f.order = ((const uint *)&b->order)[lane];
		f.instance = ((const uint *)&b->instance)[lane];
		f.primitive = ((const uint *)&b->primitive)[lane];
		f.b1 = ((const float *)&b->b1)[lane];
		f.b2 = ((const float *)&b->b2)[lane];
		f.depth = ((const float *)&b->depth)[lane];
		b->fragments[pixel] = f;
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
	const struct camera_rectangle r = camera_rectangle(view->scissor[0], view->scissor[1], view->scissor[2],
	                                                   view->scissor[3], width, height);
	const uint item = (uint)get_global_id(0), columns = (uint)(r.x1 - r.x0 + 3) / 4;
	struct block b;

	if (item >= camera_packet_items(r))
		return;
	b.view = view;
	b.instances = instances;
	b.nodes = nodes;
	b.triangles = triangles;
	b.window = window;
	b.clip = clip;
	b.after = after;
	b.fragments = fragments;
	b.width = width;
	b.mode = mode;
	b.x = r.x0 + (int)(item % columns) * 4;
	b.y = r.y0 + (int)(item / columns) * 2;
	b.inside = (b.x + LANE_X < r.x1) & (b.y + LANE_Y < r.y1);
	b.counts = 0;
	b.order = b.instance = b.primitive = SCENE_NONE;
	b.steps = 0;
	b.b1 = b.b2 = 0;
	b.depth = 1;
	make_rays(&b);
	if (view->tlas_count)
		walk_top(&b, top + view->tlas_first, instance_list);
	b.on = b.inside;
	for (uint i = 0; i < view->screen_count; i++)
		walk_screen(&b, view->screen_first + i);
	store_block(&b, counts);
}
