/*
 * Tests an 80-byte node (struct node8c) against one ray: all eight children at once, in scalar code. OpenCL C only; for
 * kernels that trace one ray per work item.
 */
#pragma once

#include "kernels/rays/walk.h"

/* Distances of a node's grid planes along one axis of the ray: `near` or `far` plus `byte` times step. */
struct grid_axis {
	float near, near_step, far, far_step;
};

/* The same slack as for other boxes, in proportion to the terms: the grid's origin, and the ray's. */
static inline struct grid_axis grid_axis(float origin, uint exponent, float i, float near, float far)
{
	const float step = as_float(exponent << 23) * i, at = origin * i;
	struct grid_axis axis;

	axis.near = fma(origin, i, near) - fabs(at) * 4e-7f;
	axis.near_step = step;
	axis.far = fma(origin, i, far) + fabs(at) * 1.6e-6f;
	axis.far_step = step * (1 + 6e-7f);
	return axis;
}

static inline float byte_of(uint word, uint k)
{
	return convert_float(word >> 8 * k & 255u);
}

/*
 * The children of a node that the ray meets.
 * @param octant     a set bit: the ray's direction is positive along that axis
 * @param triangles  receives a bit for each triangle of the leaves that it meets, counted from triangle_first
 * @param head       receives the node's first children: x nodes, y triangles
 * @return a bit for each node that it meets, at slot ^ octant, with the nearest last; from bit 8 on, the slots that are
 *         nodes
 */
static inline uint meet_compressed(const struct walk *w, uint octant, __global const struct node8c *node,
                                   uint *triangles, uint2 *head)
{
	__global const uint4 *row = (__global const uint4 *)node;
	const uint4 a = row[0], b = row[1], c = row[2], d = row[3], e = row[4];
	const struct grid_axis x = grid_axis(as_float(a.x), a.w & 255u, w->ix, w->near_x, w->far_x);
	const struct grid_axis y = grid_axis(as_float(a.y), a.w >> 8 & 255u, w->iy, w->near_y, w->far_y);
	const struct grid_axis z = grid_axis(as_float(a.z), a.w >> 16 & 255u, w->iz, w->near_z, w->far_z);
	const uint2 near_x = w->ix < 0 ? d.zw : c.xy, far_x = w->ix < 0 ? c.xy : d.zw;
	const uint2 near_y = w->iy < 0 ? e.xy : c.zw, far_y = w->iy < 0 ? c.zw : e.xy;
	const uint2 near_z = w->iz < 0 ? e.zw : d.xy, far_z = w->iz < 0 ? d.xy : e.zw;
	const uint is_node = a.w >> 24;
	uint hits = 0;

	*triangles = 0;
	*head = b.xy;
	for (uint slot = 0; slot < 8; slot++) {
		const uint k = slot & 3u;
		const float enter = fmax(fmax(fma(byte_of(slot < 4 ? near_x.x : near_x.y, k), x.near_step, x.near),
		                              fma(byte_of(slot < 4 ? near_y.x : near_y.y, k), y.near_step, y.near)),
		                         fmax(fma(byte_of(slot < 4 ? near_z.x : near_z.y, k), z.near_step, z.near), w->t_min));
		const float leave = fmin(fmin(fma(byte_of(slot < 4 ? far_x.x : far_x.y, k), x.far_step, x.far),
		                              fma(byte_of(slot < 4 ? far_y.x : far_y.y, k), y.far_step, y.far)),
		                         fmin(fma(byte_of(slot < 4 ? far_z.x : far_z.y, k), z.far_step, z.far), walk_end(w)));
		const uint meta = (slot < 4 ? b.z : b.w) >> 8 * k & 255u;

		if (enter <= leave) {
			hits |= (is_node >> slot & 1u) << (slot ^ octant);
			*triangles |= meta ? ((2u << (meta >> 5 & 3u)) - 1u) << (meta & 31u) : 0u;
		}
	}
	return hits | is_node << 8;
}
