/*
 * One ray against eight-wide trees. OpenCL C only; included by the kernels that walk them.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"
#include "kernels/rays/rays.h"
#include "kernels/rays/lanes.h"
#include "kernels/rays/walk.h"
#include "kernels/rays/opacity.h"

/* Find where the ray enters the eight boxes. @return a bit for each box that it meets */
static inline uint meet_boxes(const struct walk *w, __global const struct node8 *node, float8 *enter)
{
	__global const float *rows = (__global const float *)node;
	const float8 near_x = fma(vload8(0, rows + w->row_x), w->ix, w->near_x);
	const float8 near_y = fma(vload8(0, rows + w->row_y), w->iy, w->near_y);
	const float8 near_z = fma(vload8(0, rows + w->row_z), w->iz, w->near_z);
	const float8 far_x = fma(vload8(0, rows + (24 - w->row_x)), w->far_ix, w->far_x);
	const float8 far_y = fma(vload8(0, rows + (40 - w->row_y)), w->far_iy, w->far_y);
	const float8 far_z = fma(vload8(0, rows + (56 - w->row_z)), w->far_iz, w->far_z);
	const float8 first = lanes_max(lanes_max(near_x, near_y), lanes_max(near_z, w->t_min));

	*enter = first;
	return lane_bits(first <= lanes_min(lanes_min(far_x, far_y), lanes_min(far_z, walk_end(w))));
}

/*
 * Push the children that the ray meets, farthest first, so that the nearest is popped next; any-hit queries use any
 * order.
 */
static inline uint push_boxes(struct entry *stack, uint depth, uint bits, const float8 *enter, int any,
                       __global const struct node8 *node)
{
	const uint bottom = any ? RAYS_WIDE_STACK : depth;

	while (bits) {
		const uint lane = popcount((bits & -bits) - 1);
		const float t = ((const float *)enter)[lane];
		uint place = depth++;

		bits &= bits - 1;
		while (place > bottom && stack[place - 1].enter < t) {
			stack[place] = stack[place - 1];
			place--;
		}
		stack[place].enter = t;
		stack[place].child = node->child[lane];
		stack[place].count = node->count[lane];
	}
	return depth;
}

/* Knowledge of an instance's triangles for any-hit queries: by side (rays_passes), and by kernels/rays/opacity.h. */
struct known {
	__global const uint *words;
	uint opacity, passes, to_lights;
};

static inline struct known known_of(__global const struct instance *instance, int any, uint to_lights,
                                    __global const uint *words)
{
	struct known k;

	k.words = words;
	k.opacity = any ? instance->opacity : OPACITY_STOPS;
	k.passes = any ? rays_passes(instance->flags, to_lights) : 0;
	k.to_lights = to_lights;
	return k;
}

/* The effect of a primitive on an any-hit query's ray: OPACITY_STOPS, _PASSES or _ASK. inverse: of the determinant */
static inline uint known_opacity(struct known k, uint primitive, float inverse, float b1, float b2)
{
	const uint word = opacity_word(k.words, k.opacity, primitive);

	if ((k.passes | opacity_sides(word, k.to_lights)) & rays_side(inverse))
		return OPACITY_PASSES;
	return opacity_at(k.words, k.opacity, word, b1, b2);
}

/* Moeller and Trumbore on eight triangles. w->hit receives the nearest hit or, among equals, that of the lowest
 * primitive; of any-hit queries, one that stops the ray. known: for any-hit queries, which set w->asks to 1 after a hit
 * that has to be sampled */
static inline void try_block(struct walk *w, __global const struct triangle8 *block, uint instance, int any,
                             struct known known)
{
	const float8 e1x = vload8(0, block->e1[0]), e1y = vload8(0, block->e1[1]), e1z = vload8(0, block->e1[2]);
	const float8 e2x = vload8(0, block->e2[0]), e2y = vload8(0, block->e2[1]), e2z = vload8(0, block->e2[2]);
	const float8 px = fma(w->dy, e2z, -(w->dz * e2y));
	const float8 py = fma(w->dz, e2x, -(w->dx * e2z));
	const float8 pz = fma(w->dx, e2y, -(w->dy * e2x));
	const float8 inverse = 1.0f / fma(e1z, pz, fma(e1y, py, e1x * px));
	const float8 sx = w->ox - vload8(0, block->v0[0]), sy = w->oy - vload8(0, block->v0[1]);
	const float8 sz = w->oz - vload8(0, block->v0[2]);
	const float8 u = fma(sz, pz, fma(sy, py, sx * px)) * inverse;
	const float8 qx = fma(sy, e1z, -(sz * e1y));
	const float8 qy = fma(sz, e1x, -(sx * e1z));
	const float8 qz = fma(sx, e1y, -(sy * e1x));
	const float8 v = fma(w->dz, qz, fma(w->dy, qy, w->dx * qx)) * inverse;
	const float8 t = fma(e2z, qz, fma(e2y, qy, e2x * qx)) * inverse;
	uint bits = lane_bits((u >= -RAYS_EDGE_SLACK) & (v >= -RAYS_EDGE_SLACK) & (u + v <= 1 + RAYS_EDGE_SLACK) &
	                      (t >= w->t_min) & (t <= w->hit.t));

	while (bits) {
		const uint lane = popcount((bits & -bits) - 1);
		const float at = ((const float *)&t)[lane];
		const float e1 = largest(block->e1[0][lane], block->e1[1][lane], block->e1[2][lane]);
		const float e2 = largest(block->e2[0][lane], block->e2[1][lane], block->e2[2][lane]);

		bits &= bits - 1;
		if ((at < w->hit.t || (at == w->hit.t && block->primitive[lane] < w->hit.primitive)) &&
		    (any || walk_is_after(w, at, block->primitive[lane])) &&
		    RAYS_FLAT * e1 * e2 * (largest(w->dx, w->dy, w->dz) * fabs(((const float *)&inverse)[lane])) < 1) {
			if (any) {
				const uint does = known_opacity(known, block->primitive[lane], ((const float *)&inverse)[lane],
				                                ((const float *)&u)[lane], ((const float *)&v)[lane]);

				w->asks |= does == OPACITY_ASK;
				if (does != OPACITY_STOPS)
					continue;
			}
			w->hit.t = at;
			w->hit.b1 = ((const float *)&u)[lane];
			w->hit.b2 = ((const float *)&v)[lane];
			w->hit.instance = instance;
			w->hit.primitive = block->primitive[lane];
			if (any)
				return;
		}
	}
}

/* Walk down from a node (y: 0) or a leaf of y blocks. */
static inline void walk_subtree(struct walk *w, uint2 start, uint instance, int any, struct known known,
                                __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	struct entry stack[RAYS_WIDE_STACK], entry;
	uint depth = 0;

	entry.enter = w->t_min;
	entry.child = start.x;
	entry.count = start.y;
	for (;;) {
		if (entry.count == 0) {
			__global const struct node8 *node = &nodes[entry.child];
			float8 enter;
			const uint bits = meet_boxes(w, node, &enter);

			if (bits && (bits & (bits - 1)) == 0) { /* a single one: continue with it, bypassing the stack */
				const uint lane = popcount(bits - 1);

				entry.child = node->child[lane];
				entry.count = node->count[lane];
				continue;
			}
			depth = push_boxes(stack, depth, bits, &enter, any, node);
		}
		for (uint i = 0; i < entry.count; i++) {
			try_block(w, &triangles[entry.child + i], instance, any, known);
			if (any && w->hit.instance != SCENE_NONE)
				return;
		}
		do {
			if (depth == 0)
				return;
			entry = stack[--depth];
		} while (entry.enter > walk_end(w));
	}
}
