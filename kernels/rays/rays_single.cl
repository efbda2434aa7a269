/*
 * occlude_binary, intersect_binary, occlude_compressed, intersect_compressed: one ray per work item in scalar code, for
 * devices that run many work items in lockstep (GPUs). See kernels/rays/rays.h.
 *
 * Both walk the binary top level. Below it, *_binary goes down the binary tree to a leaf, then through its triangles
 * ("while-while", Aila and Laine 2009, "Understanding the efficiency of ray traversal on GPUs"); *_compressed walks
 * eight-wide nodes of 80 bytes in the order of the ray's octant (Ylitie, Karras and Laine 2017, section 4). Stacks are
 * in private memory. They have room for the deepest tree, but a ray touches only the few entries that it needs.
 */
#include "kernels/common.h"
#include "kernels/kernels.h"
#include "kernels/rays/compressed_node.h"
#include "kernels/rays/rays.h"
#include "kernels/rays/walk.h"

/* Moeller and Trumbore; among equally near hits, the lowest primitive wins. */
static inline void try_single(struct walk *w, __global const struct triangle *triangle, uint instance, uint passes)
{
	const float e1x = triangle->e1[0], e1y = triangle->e1[1], e1z = triangle->e1[2];
	const float e2x = triangle->e2[0], e2y = triangle->e2[1], e2z = triangle->e2[2];
	const float px = fma(w->dy, e2z, -(w->dz * e2y));
	const float py = fma(w->dz, e2x, -(w->dx * e2z));
	const float pz = fma(w->dx, e2y, -(w->dy * e2x));
	const float inverse = 1.0f / fma(e1z, pz, fma(e1y, py, e1x * px));
	const float sx = w->ox - triangle->v0[0], sy = w->oy - triangle->v0[1], sz = w->oz - triangle->v0[2];
	const float u = fma(sz, pz, fma(sy, py, sx * px)) * inverse;
	const float qx = fma(sy, e1z, -(sz * e1y));
	const float qy = fma(sz, e1x, -(sx * e1z));
	const float qz = fma(sx, e1y, -(sy * e1x));
	const float v = fma(w->dz, qz, fma(w->dy, qy, w->dx * qx)) * inverse;
	const float t = fma(e2z, qz, fma(e2y, qy, e2x * qx)) * inverse;

	if (u >= -RAYS_EDGE_SLACK && v >= -RAYS_EDGE_SLACK && u + v <= 1 + RAYS_EDGE_SLACK && t >= w->t_min &&
	    (t < w->hit.t || (t == w->hit.t && triangle->primitive < w->hit.primitive)) && !(passes & rays_side(inverse)) &&
	    walk_is_after(w, t, triangle->primitive) &&
	    RAYS_FLAT * largest(e1x, e1y, e1z) * largest(e2x, e2y, e2z) * (largest(w->dx, w->dy, w->dz) * fabs(inverse)) < 1) {
		w->hit.t = t;
		w->hit.b1 = u;
		w->hit.b2 = v;
		w->hit.instance = instance;
		w->hit.primitive = triangle->primitive;
	}
}

/* --- Binary trees ------------------------------------------------------------------------------------------------ */

/* Test whether the ray meets a box, and where it enters. An empty box has lo > hi. */
static inline int meets_box(const struct walk *w, struct vec3 lo, struct vec3 hi, float *enter)
{
	const float near_x = fma(w->ix < 0 ? hi.x : lo.x, w->ix, w->near_x),
		    far_x = fma(w->ix < 0 ? lo.x : hi.x, w->far_ix, w->far_x);
	const float near_y = fma(w->iy < 0 ? hi.y : lo.y, w->iy, w->near_y),
		    far_y = fma(w->iy < 0 ? lo.y : hi.y, w->far_iy, w->far_y);
	const float near_z = fma(w->iz < 0 ? hi.z : lo.z, w->iz, w->near_z),
		    far_z = fma(w->iz < 0 ? lo.z : hi.z, w->far_iz, w->far_z);

	*enter = fmax(fmax(near_x, near_y), fmax(near_z, w->t_min));
	return lo.x <= hi.x && *enter <= fmin(fmin(far_x, far_y), fmin(far_z, walk_end(w)));
}

/* Pop the next subtree that is not behind the hit found meanwhile. @return 0: there is none */
static inline int pop(const struct walk *w, const struct entry *stack, uint *depth, struct entry *entry)
{
	do {
		if (*depth == 0)
			return 0;
		*entry = stack[--*depth];
	} while (entry->enter > walk_end(w));
	return 1;
}

/* Go to the next leaf, nearer child first. @return 0: there is none */
static inline int next_leaf(const struct walk *w, __global const struct node2 *nodes, struct entry *stack, uint *depth,
                     struct entry *entry)
{
	while (entry->count == 0) {
		__global const float4 *row = (__global const float4 *)&nodes[entry->child];
		const float4 a = row[0], b = row[1], c = row[2];
		const uint4 d = as_uint4(row[3]); /* child[2], count[2] */
		struct entry left, right;
		const int meets_left = meets_box(w, v3(a.x, a.y, a.z), v3(b.z, b.w, c.x), &left.enter);
		const int meets_right = meets_box(w, v3(a.w, b.x, b.y), v3(c.y, c.z, c.w), &right.enter);

		left.child = d.x, left.count = d.z;
		right.child = d.y, right.count = d.w;
		if (meets_left && meets_right) {
			const int swap = right.enter < left.enter;

			stack[*depth] = swap ? left : right;
			++*depth;
			*entry = swap ? right : left;
		} else if (meets_left || meets_right) {
			*entry = meets_left ? left : right;
		} else if (!pop(w, stack, depth, entry)) {
			return 0;
		}
	}
	return 1;
}

static inline void walk_binary(struct walk *w, uint index, int any, uint passes, __global const struct node2 *nodes,
                        __global const struct triangle *triangles)
{
	struct entry stack[BVH_MAX_DEPTH], entry;
	uint depth = 0;

	entry.enter = w->t_min;
	entry.child = entry.count = 0;
	while (next_leaf(w, nodes, stack, &depth, &entry)) {
		for (uint i = 0; i < entry.count; i++) {
			try_single(w, &triangles[entry.child + i], index, passes);
			if (any && w->hit.instance != SCENE_NONE)
				return;
		}
		if (!pop(w, stack, &depth, &entry))
			return;
	}
}

/* --- Compressed trees -------------------------------------------------------------------------------------------- */

static inline void walk_compressed(struct walk *w, uint index, int any, uint passes,
                                   __global const struct node8c *nodes, __global const struct triangle *triangles)
{
	const uint octant = (w->dx < 0 ? 0u : 1u) | (w->dy < 0 ? 0u : 2u) | (w->dz < 0 ? 0u : 4u);
	uint2 stack[NODE8C_MAX_DEPTH]; /* groups of siblings to visit: first index, meet_compressed's result */
	uint depth = 0, child = 0;

	for (;;) {
		uint bits, near, slot;
		uint2 first, group; /* first: the node's first children, x nodes, y triangles */

		group.y = meet_compressed(w, octant, &nodes[child], &bits, &first);
		group.x = first.x;
		while (bits) {
			try_single(w, &triangles[first.y + popcount((bits & -bits) - 1)], index, passes);
			bits &= bits - 1;
			if (any && w->hit.instance != SCENE_NONE)
				return;
		}
		if (!(group.y & 255u)) {
			if (depth == 0)
				return;
			group = stack[--depth];
		}
		near = 31 - clz(group.y & 255u);
		slot = near ^ octant;
		group.y &= ~(1u << near);
		if (group.y & 255u)
			stack[depth++] = group;
		child = group.x + popcount(group.y >> 8 & ((1u << slot) - 1u));
	}
}

/* --- Rays -------------------------------------------------------------------------------------------------------- */

/*
 * The type of the trees is a constant in each kernel, so the kernel only has stacks of its own type. While an instance
 * is walked, only the hit of the eye-space ray is kept; the rest is read and computed again, which costs less than the
 * registers.
 */
INLINED struct hit walk_ray(__global const struct ray *ray, int any, uint to_lights, __global const struct hit *last,
                            int is_compressed,
                            __global const struct node2 *top, __global const uint *instance_list,
                            __global const struct instance *instances, __global const struct node2 *binary,
                            __global const struct node8c *compressed, __global const struct triangle *triangles)
{
	struct entry stack[BVH_MAX_DEPTH], entry;
	struct walk eye;
	uint depth = 0;

	if (!walk_start(&eye, ray, last != 0))
		return eye.hit;
	entry.enter = eye.t_min;
	entry.child = entry.count = 0;
	while (next_leaf(&eye, top, stack, &depth, &entry)) {
		for (uint i = 0; i < entry.count; i++) {
			const uint index = instance_list[entry.child + i];
			__global const struct instance *instance = &instances[index];
			struct hit hit = eye.hit;
			struct walk w;
			const float shift = walk_enter(&w, &eye, instance, last ? walk_tie(last, index) : 0);
			const uint passes = rays_passes(instance->flags, to_lights);

			if (is_compressed)
				walk_compressed(&w, index, any, passes, compressed + instance->node8c_first,
				                triangles + instance->triangle8c_first);
			else
				walk_binary(&w, index, any, passes, binary + instance->node2_first, triangles + instance->triangle_first);
			walk_start(&eye, ray, last != 0);
			eye.hit = hit;
			walk_leave(&eye, &w, shift);
			if (any && eye.hit.instance != SCENE_NONE)
				return eye.hit;
		}
		if (!pop(&eye, stack, &depth, &entry))
			break;
	}
	return eye.hit;
}

__kernel void occlude_binary(KERNEL_ARGUMENTS(occlude_binary))
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		occluded[i] = walk_ray(&rays[i], 1, to_lights, 0, 0, top + top_first, instance_list, instances, nodes, 0,
		                       triangles)
		                      .instance != SCENE_NONE;
}

__kernel void intersect_binary(KERNEL_ARGUMENTS(intersect_binary))
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		hits[i] = walk_ray(&rays[i], 0, 0, after ? &last[i] : 0, 0, top + top_first, instance_list, instances, nodes, 0,
		                   triangles);
}

__kernel void occlude_compressed(KERNEL_ARGUMENTS(occlude_compressed))
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		occluded[i] = walk_ray(&rays[i], 1, to_lights, 0, 1, top + top_first, instance_list, instances, 0, nodes,
		                       triangles)
		                      .instance != SCENE_NONE;
}

__kernel void intersect_compressed(KERNEL_ARGUMENTS(intersect_compressed))
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		hits[i] = walk_ray(&rays[i], 0, 0, after ? &last[i] : 0, 1, top + top_first, instance_list, instances, 0, nodes,
		                   triangles);
}
